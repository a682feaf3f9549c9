import moment_shadows::techniques::exponential::{exponential_mean_of_texel, exponential_shadow_intensity};
import node::map_texel::{map_texel};
import node::specialization::{EXPONENT, STORAGE};
import node::technique_receiver::{TechniqueReceiver};

// Texels hold logarithms, which the node decodes before it blends four of them; here there is one.
fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let mean = exponential_mean_of_texel(map_texel(receiver, 0u), STORAGE, EXPONENT, true);
    return exponential_shadow_intensity(mean, receiver.fragment_depth, EXPONENT, 0.0);
}
