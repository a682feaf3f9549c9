import moment_shadows::moments::four_moments::{four_moments_from_depth, four_moments_to_texel};
import node::occluders_shares::{Occluders};
import node::specialization::{GROUP, MomentsStorage, STORAGE};

// Four moments of two occluders in rectified coordinates.

@group(GROUP) @binding(1) var rectified_map: MomentsStorage;

fn moments_of(depth: f32, shares: vec2f) -> vec4f {
    let ends = shares.x * four_moments_from_depth(-1.0) + (1.0 - shares.x - shares.y) * four_moments_from_depth(1.0);
    return shares.y * four_moments_from_depth(clamp(depth, -1.0, 1.0)) + ends;
}

fn rectified_store(place: vec2u, occluders: Occluders, weights: vec2f) {
    let sums = weights.x * moments_of(occluders.depths.x, occluders.shares[0]) + weights.y * moments_of(occluders.depths.y, occluders.shares[1]);
    textureStore(rectified_map, place, four_moments_to_texel(sums, STORAGE));
}
