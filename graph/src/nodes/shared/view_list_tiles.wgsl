import node::specialization::{TILE, VIEWS};
import node::tile_words::{tile_words};

// The views that may contain a pixel: those that were found for its tile, a bit for each.

// The first of them from number `least` on; VIEWS or more where there is none.
fn view_list_next(pixel: vec2i, least: u32) -> u32 {
    var next = least;
    while next < VIEWS {
        let rest = tile_words(pixel / TILE, next / 128u)[next / 32u % 4u] >> (next % 32u);
        if rest != 0u {
            return next + firstTrailingBit(rest);
        }
        next = (next | 31u) + 1u;
    }
    return next;
}
