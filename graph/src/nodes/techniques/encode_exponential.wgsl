import moment_shadows::techniques::exponential::{exponential_channels, exponential_to_texel};
import node::specialization::{EXPONENT, LOGARITHMIC, STORAGE};

// The exponential of depth: what is averaged for a moment depth, and the texel for the mean.

fn encoding_channels(z: f32) -> vec4f {
    return exponential_channels(z, EXPONENT);
}

fn encoding_texel(mean: vec4f) -> vec4f {
    return exponential_to_texel(mean, STORAGE, EXPONENT, LOGARITHMIC);
}
