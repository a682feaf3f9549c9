import moment_shadows::exponential::{exponential_mean_of_texel, exponential_shadow_intensity};
import moment_shadows::map_texel::{map_texel};
import moment_shadows::specialization::{EXPONENT, STORAGE};
import moment_shadows::technique_receiver::{TechniqueReceiver};

// Texels hold logarithms, which the node decodes before it blends four of them; here there is one.
fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let mean = exponential_mean_of_texel(map_texel(receiver, 0u), STORAGE, EXPONENT, true);
    return exponential_shadow_intensity(mean, receiver.fragment_depth, EXPONENT, 0.0);
}
