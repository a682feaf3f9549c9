import moment_shadows::bounds::hamburger4::{hamburger4_shadow_intensity};
import node::map_texel::{map_texel};
import moment_shadows::moments::four_moments::{FourMomentsBias, four_moments_from_texel};
import node::specialization::{STORAGE};
import node::technique_receiver::{TechniqueReceiver};

// By four moments with another bias.
fn point_intensity(receiver: TechniqueReceiver, moment_bias: FourMomentsBias) -> f32 {
    let moments = four_moments_from_texel(map_texel(receiver, 0u), STORAGE);
    return hamburger4_shadow_intensity(moments, receiver.fragment_depth, moment_bias);
}
