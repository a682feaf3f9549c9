import moment_shadows::specialization::{STORAGE};
import moment_shadows::variance::{variance_channels, variance_to_texel};

// Two moments: what is averaged for a moment depth, and the texel for the mean.

fn encoding_channels(z: f32) -> vec4f {
    return variance_channels(z);
}

fn encoding_texel(mean: vec4f) -> vec4f {
    return variance_to_texel(mean, STORAGE);
}
