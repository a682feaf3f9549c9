import moment_shadows::moments::{moments_from_depth, moments_to_texel};
import moment_shadows::specialization::{STORAGE};

// Four moments of two occluders in rectified coordinates.

fn rectified_texel(depths: vec2f, weights: vec2f) -> vec4f {
    let sums = weights.x * moments_from_depth(depths.x) + weights.y * moments_from_depth(depths.y);
    return moments_to_texel(sums, STORAGE);
}
