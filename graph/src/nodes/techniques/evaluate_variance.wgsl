import node::map_texel::{map_texel};
import node::specialization::{STORAGE};
import node::technique_receiver::{TechniqueReceiver};
import moment_shadows::bounds::chebyshev::{chebyshev_shadow_intensity_of_texel};

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    return chebyshev_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE);
}
