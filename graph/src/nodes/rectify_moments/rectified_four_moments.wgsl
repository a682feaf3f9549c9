import moment_shadows::moments::four_moments::{four_moments_from_depth, four_moments_to_texel};
import node::specialization::{STORAGE};

// Four moments of two occluders in rectified coordinates.

fn rectified_texel(depths: vec2f, weights: vec2f) -> vec4f {
    let sums = weights.x * four_moments_from_depth(depths.x) + weights.y * four_moments_from_depth(depths.y);
    return four_moments_to_texel(sums, STORAGE);
}
