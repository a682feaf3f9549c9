import moment_shadows::moments::four_moments::{four_moments_from_depth, four_moments_to_texel};
import node::specialization::{GROUP, MomentsStorage, STORAGE};

// Four moments of two occluders in rectified coordinates.

@group(GROUP) @binding(1) var rectified_map: MomentsStorage;

fn rectified_store(place: vec2u, depths: vec2f, weights: vec2f) {
    let sums = weights.x * four_moments_from_depth(depths.x) + weights.y * four_moments_from_depth(depths.y);
    textureStore(rectified_map, place, four_moments_to_texel(sums, STORAGE));
}
