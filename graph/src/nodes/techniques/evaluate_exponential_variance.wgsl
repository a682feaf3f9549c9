import moment_shadows::exponential_variance::{exponential_variance_shadow_intensity_of_texel};
import moment_shadows::map_texel::{map_texel};
import moment_shadows::specialization::{BOTH_WARPS, EXPONENTS, STORAGE};
import moment_shadows::technique_receiver::{TechniqueReceiver};

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    return exponential_variance_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE, EXPONENTS, BOTH_WARPS);
}
