import moment_shadows::techniques::exponential_variance::{exponential_variance_shadow_intensity_of_texel};
import node::map_texel::{map_texel};
import node::specialization::{BOTH_WARPS, EXPONENTS, STORAGE};
import node::technique_receiver::{TechniqueReceiver};

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    return exponential_variance_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE, EXPONENTS, BOTH_WARPS);
}
