import moment_shadows::techniques::convolution::{convolution_channels, convolution_to_texel};
import node::specialization::{STORAGE, TERMS};

// Two terms of the Fourier series: what is averaged for a moment depth, and the texel for the mean.

// The plane that is made.
override PLANE: u32;

fn encoding_channels(z: f32) -> vec4f {
    return convolution_channels(z, PLANE, TERMS);
}

fn encoding_texel(mean: vec4f) -> vec4f {
    return convolution_to_texel(mean, STORAGE);
}
