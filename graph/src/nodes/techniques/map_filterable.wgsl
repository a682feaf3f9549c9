import node::moments_lookup::{moments_map};

// Width and height of the map in texels.
fn technique_map_size() -> vec2u {
    return textureDimensions(moments_map);
}
