import moment_shadows::bounds::hamburger6::{hamburger6_shadow_intensity_of_texels};
import node::map_texel::{map_texel};
import node::specialization::{STORAGE};
import node::technique_receiver::{TechniqueReceiver};

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let texels = array<vec4f, 2>(map_texel(receiver, 0u), map_texel(receiver, 1u));
    return hamburger6_shadow_intensity_of_texels(texels, receiver.fragment_depth, STORAGE);
}
