import node::map_filtering::{filtering_texel};
import node::specialization::{GROUP, MomentsStorage};

// Where a direction of the blur reads and writes: one layer each.

@group(GROUP) @binding(0) var moments_map: texture_2d<f32>;
@group(GROUP) @binding(1) var blurred_map: MomentsStorage;

// Stores a filtered texel unless it lies beyond `last`, the last texel of the region.
fn blur_store(texel: vec2i, last: vec2i, value: vec4f) {
    if all(texel <= last) {
        textureStore(blurred_map, texel, filtering_texel(value));
    }
}
