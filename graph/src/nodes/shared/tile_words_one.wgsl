import node::specialization::{GROUP};

// Which views a tile has, a bit for each of 128.

@group(GROUP) @binding(9) var tile_views: texture_2d<u32>;

fn tile_words(tile: vec2i, part: u32) -> vec4u {
    return textureLoad(tile_views, tile, 0);
}
