import node::specialization::{TILE, VIEWS};
import node::tile_words::{tile_words};

// The views that may contain a pixel: those that were found for its tile, a bit for each.

struct ViewList {
    tile: vec2i,
    // The view that is the first bit, and the bits of views that are still to come.
    first: u32,
    bits: u32,
}

// The views that may contain pixels of the tile that has this one.
fn view_list(pixel: vec2i) -> ViewList {
    let tile = pixel / TILE;
    return ViewList(tile, 0u, tile_words(tile, 0u).x);
}

// The first of them from number `least` on, which follows the one before; VIEWS or more where there is none.
fn view_list_next(list: ptr<function, ViewList>, least: u32) -> u32 {
    while (*list).bits == 0u {
        let first = (*list).first + 32u;
        (*list).first = first;
        if first >= VIEWS {
            return VIEWS;
        }
        (*list).bits = tile_words((*list).tile, first / 128u)[first / 32u % 4u];
    }
    let bits = (*list).bits;
    (*list).bits = bits & (bits - 1u);
    return (*list).first + firstTrailingBit(bits);
}
