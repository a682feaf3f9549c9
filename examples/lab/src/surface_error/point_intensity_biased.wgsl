import moment_shadows::hamburger::{hamburger_shadow_intensity};
import moment_shadows::map_texel::{map_texel};
import moment_shadows::moments::{MomentBias, moments_from_texel};
import moment_shadows::specialization::{STORAGE};
import moment_shadows::technique_receiver::{TechniqueReceiver};

// By four moments with another bias.
fn point_intensity(receiver: TechniqueReceiver, moment_bias: MomentBias) -> f32 {
    let moments = moments_from_texel(map_texel(receiver, 0u), STORAGE);
    return hamburger_shadow_intensity(moments, receiver.fragment_depth, moment_bias);
}
