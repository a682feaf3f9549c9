import moment_shadows::hamburger6::{hamburger6_shadow_intensity_of_texels};
import moment_shadows::map_texel::{map_texel};
import moment_shadows::specialization::{STORAGE};
import moment_shadows::technique_receiver::{TechniqueReceiver};

fn technique_shadow_intensity(receiver: TechniqueReceiver) -> f32 {
    let texels = array<vec4f, 2>(map_texel(receiver, 0u), map_texel(receiver, 1u));
    return hamburger6_shadow_intensity_of_texels(texels, receiver.fragment_depth, STORAGE);
}
