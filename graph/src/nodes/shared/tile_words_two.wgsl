import node::specialization::{GROUP};

// Which views a tile has, a bit for each of 128, and of 128 more.

@group(GROUP) @binding(9) var tile_views: texture_2d<u32>;
@group(GROUP) @binding(10) var tile_views_128: texture_2d<u32>;

fn tile_words(tile: vec2i, part: u32) -> vec4u {
    if part == 0u {
        return textureLoad(tile_views, tile, 0);
    }
    return textureLoad(tile_views_128, tile, 0);
}
