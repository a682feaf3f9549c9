import moment_shadows::moments::enclosed_moments::{enclosed_moments_of_occluder, enclosed_moments_sum, enclosed_moments_to_even_texel, enclosed_moments_to_odd_texel};
import node::specialization::{STORAGE};

// Three of six moments of two occluders in rectified coordinates.

// The plane that is made: 0 for odd moments, 1 for even ones.
override PLANE: u32;

fn rectified_texel(depths: vec2f, weights: vec2f) -> vec4f {
    let near = enclosed_moments_of_occluder(depths.x, weights.x);
    let far = enclosed_moments_of_occluder(depths.y, weights.y);
    let sums = enclosed_moments_sum(near, far);
    if PLANE == 0u {
        return enclosed_moments_to_odd_texel(sums, STORAGE);
    }
    return enclosed_moments_to_even_texel(sums, STORAGE);
}
