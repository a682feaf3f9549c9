import moment_shadows::moments::enclosed_moments::{enclosed_moments_of_occluder, enclosed_moments_sum, enclosed_moments_to_even_texel, enclosed_moments_to_odd_texel};
import node::occluders_shares::{Occluders};
import node::specialization::{GROUP, MomentsStorage, STORAGE};

// Six moments of two occluders in rectified coordinates, in two planes.

@group(GROUP) @binding(1) var rectified_map: MomentsStorage;
@group(GROUP) @binding(4) var rectified_even: MomentsStorage;

fn rectified_store(place: vec2u, occluders: Occluders, weights: vec2f) {
    let near = enclosed_moments_of_occluder(occluders.depths.x, weights.x * occluders.shares[0]);
    let far = enclosed_moments_of_occluder(occluders.depths.y, weights.y * occluders.shares[1]);
    let sums = enclosed_moments_sum(near, far);
    textureStore(rectified_map, place, enclosed_moments_to_odd_texel(sums, STORAGE));
    textureStore(rectified_even, place, enclosed_moments_to_even_texel(sums, STORAGE));
}
