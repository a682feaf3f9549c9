import node::specialization::{GROUP};

// A plain depth map.

@group(GROUP) @binding(2) var depth_map: texture_depth_2d_array;

// Width and height of the map in texels.
fn technique_map_size() -> vec2u {
    return textureDimensions(depth_map);
}
