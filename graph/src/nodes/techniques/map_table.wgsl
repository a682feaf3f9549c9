import node::specialization::{GROUP};

// A summed-area table.

@group(GROUP) @binding(2) var table_sums: texture_2d_array<u32>;

// Width and height of the map in texels.
fn technique_map_size() -> vec2u {
    return textureDimensions(table_sums);
}
