import moment_shadows::exponential::{exponential_shadow_intensity_of_texel};
import moment_shadows::map_texel::{map_texel};
import moment_shadows::specialization::{EXPONENT, STORAGE};
import moment_shadows::technique_receiver::{TechniqueReceiver};

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    return exponential_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE, EXPONENT, false);
}
