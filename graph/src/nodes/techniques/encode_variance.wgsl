import node::specialization::{STORAGE};
import moment_shadows::moments::two_moments::{two_moments_from_depth, two_moments_to_texel};

// Two moments: what is averaged for a moment depth, and the texel for the mean.

fn encoding_channels(z: f32) -> vec4f {
    return two_moments_from_depth(z);
}

fn encoding_texel(mean: vec4f) -> vec4f {
    return two_moments_to_texel(mean, STORAGE);
}
