// The views that may contain a pixel: all.

// The first of them from number `least` on; VIEWS or more where there is none.
fn view_list_next(pixel: vec2i, least: u32) -> u32 {
    return least;
}
