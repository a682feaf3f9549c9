import moment_shadows::bounds::hausdorff4::{hausdorff4_shadow_intensity_of_texel};
import node::map_texel::{map_texel};
import node::specialization::{STORAGE};
import node::technique_receiver::{TechniqueReceiver};

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    return hausdorff4_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE);
}
