import moment_shadows::techniques::layered_variance::{layered_variance_channels};
import node::specialization::{STORAGE};
import node::technique_layers::{technique_layers};
import moment_shadows::moments::two_moments::{two_moments_to_texel};

// Two moments of each of two layers: what is averaged for a moment depth, and the texel for the mean.

// The plane that is made.
override PLANE: u32;

fn encoding_channels(z: f32) -> vec4f {
    return layered_variance_channels(z, technique_layers(0u), PLANE);
}

fn encoding_texel(mean: vec4f) -> vec4f {
    return two_moments_to_texel(mean, STORAGE);
}
