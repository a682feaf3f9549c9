import moment_shadows::moments::{moments_from_depth, moments_to_texel};
import moment_shadows::specialization::{STORAGE};

// Four moments: what is averaged for a moment depth, and the texel for the mean.

fn encoding_channels(z: f32) -> vec4f {
    return moments_from_depth(z);
}

fn encoding_texel(mean: vec4f) -> vec4f {
    return moments_to_texel(mean, STORAGE);
}
