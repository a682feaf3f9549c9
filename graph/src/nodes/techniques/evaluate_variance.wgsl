import moment_shadows::map_texel::{map_texel};
import moment_shadows::specialization::{STORAGE};
import moment_shadows::technique_receiver::{TechniqueReceiver};
import moment_shadows::variance::{variance_shadow_intensity_of_texel};

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    return variance_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE);
}
