// Views of lights overlap: cascades, whose coarser ones go on around finer ones, and what ends in the open, a spot's cone or the last
// cascade. Along its border a view gives way to the others that contain a place, or to light.
//
// A place takes of each view that contains it, the finest first, a share of what the ones before have left: no line is seen where one
// ends, since it takes nothing there.

// How many texels a place in a region of `extent` texels (`uv` from 0 to 1) lies within its border; negative outside. The border
// lies `guard` texels within the region; a round one is the circle in the square, a spot's cone.
fn view_border_depth(uv: vec2f, extent: vec2f, guard: f32, is_round: bool) -> f32 {
    let edges = min(uv, 1.0 - uv) * extent;
    let circle = (0.5 - distance(uv, vec2f(0.5))) * min(extent.x, extent.y);
    return select(min(edges.x, edges.y), circle, is_round) - guard;
}

// Which part of a place a view takes that contains it so many texels within its border of `width` texels, and which part of that
// it shades: the same, but where its shadows fade out. The first is above 0, so that a place that no other view contains is the
// view's: divide the sum of what views shade by the sum of what they take.
fn view_border_parts(depth: f32, width: f32, fades: bool) -> vec2f {
    let part = select(clamp(depth / max(width, 0.0625), 0.0, 1.0), 1.0, width <= 0.0);
    return select(vec2f(max(part, 1e-6)), vec2f(1.0, part), fades);
}
