import moment_shadows::moments::six_moments::{six_moments_from_depth, six_moments_to_even_texel, six_moments_to_odd_texel};
import node::specialization::{STORAGE};

// Three of six moments: what is averaged for a moment depth, and the texel for the mean.

// The plane that is made: 0 for odd moments, 1 for even ones.
override PLANE: u32;

fn encoding_channels(z: f32) -> vec4f {
    let moments = six_moments_from_depth(z);
    return vec4f(select(moments.even, moments.odd, PLANE == 0u), 1.0);
}

fn encoding_texel(mean: vec4f) -> vec4f {
    if PLANE == 0u {
        return six_moments_to_odd_texel(mean.xyz, STORAGE);
    }
    return six_moments_to_even_texel(mean.xyz, STORAGE);
}
