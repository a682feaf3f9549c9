import moment_shadows::techniques::exponential_variance::{exponential_variance_channels, exponential_variance_to_texel};
import node::specialization::{EXPONENTS, STORAGE};

// Two moments of each exponential warp: what is averaged for a moment depth, and the texel for the mean.

fn encoding_channels(z: f32) -> vec4f {
    return exponential_variance_channels(z, EXPONENTS);
}

fn encoding_texel(mean: vec4f) -> vec4f {
    return exponential_variance_to_texel(mean, STORAGE);
}
