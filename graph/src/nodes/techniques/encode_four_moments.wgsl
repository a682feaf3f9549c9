import moment_shadows::moments::four_moments::{four_moments_from_depth, four_moments_to_texel};
import node::specialization::{STORAGE};

// Four moments: what is averaged for a moment depth, and the texel for the mean.

fn encoding_channels(z: f32) -> vec4f {
    return four_moments_from_depth(z);
}

fn encoding_texel(mean: vec4f) -> vec4f {
    return four_moments_to_texel(mean, STORAGE);
}
