// The views that may contain a pixel: all.

struct ViewList {
    next: u32,
}

// The views that may contain pixels of the tile that has this one.
fn view_list(pixel: vec2i) -> ViewList {
    return ViewList(0u);
}

// The next of them; VIEWS or more where there is none.
fn view_list_next(list: ptr<function, ViewList>) -> u32 {
    let next = (*list).next;
    (*list).next = next + 1u;
    return next;
}
