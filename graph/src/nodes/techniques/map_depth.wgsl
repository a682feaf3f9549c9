import node::specialization::{GROUP};

// A plain depth map, and the sampler of techniques that compare.

@group(GROUP) @binding(2) var depth_map: texture_depth_2d_array;
@group(GROUP) @binding(3) var comparison_sampler: sampler_comparison;

// Width and height of the map in texels.
fn technique_map_size() -> vec2u {
    return textureDimensions(depth_map);
}
