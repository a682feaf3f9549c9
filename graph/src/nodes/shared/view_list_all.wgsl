// The views that may contain a pixel: all.

struct ViewList {
    tile: vec2i,
}

// The views that may contain pixels of the tile that has this one.
fn view_list(pixel: vec2i) -> ViewList {
    return ViewList(pixel);
}

// The first of them from number `least` on, which follows the one before; VIEWS or more where there is none.
fn view_list_next(list: ptr<function, ViewList>, least: u32) -> u32 {
    return least;
}
