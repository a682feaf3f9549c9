import super::super::map::depth::{depth_is_nan};

// The plane of a receiver over a depth map: what each tap of a filter is compared with.
//
// A filter that compares every tap with the fragment's own depth counts half of a tilted receiver as its occluder. Comparing
// with the depth of the receiver's plane at the tap instead leaves what stands in front of that plane. For parallel rays
// moment depth on a plane is linear over the map. For rays from a point its distance from the light is the receiver's
// over a linear function.

// A receiver as a region of a depth map sees it.
struct ReceiverPlane {
    // Its place from 0 to 1 across the region.
    uv: vec2f,
    // The gradient of moment depth per texel there.
    gradient: vec2f,
    // Its moment depth.
    depth: f32,
    // 1 / the difference of moment depth between receiver and light; next to 0 for parallel rays.
    inverse_reach: f32,
}

// A number above every gradient and depth that matters; products of it with distances in texels are finite.
const RECEIVER_PLANE_LARGEST: f32 = 1e15;

// The plane of a receiver. `uv` outside of [0, 1] counts as the nearer edge, a `depth` that is NaN as the far end.
// `gradient` is that of moment depth per texel (`receiver_bias_plane`); where it is longer than `steepest` the surface is
// edge-on to the light, or the neighbours belong to another one: it is shortened to that. `light_depth` is the moment
// depth of the light itself (`depth_of_light`), below -1: DEPTH_INFINITELY_FAR for parallel rays.
fn receiver_plane_through(uv: vec2f, depth: f32, gradient: vec2f, steepest: f32, light_depth: f32) -> ReceiverPlane {
    let z = select(clamp(depth, -1e6, 1e6), 1.0, depth_is_nan(depth));
    let full = clamp(gradient, vec2f(-RECEIVER_PLANE_LARGEST), vec2f(RECEIVER_PLANE_LARGEST));
    let limit = clamp(steepest, 0.0, RECEIVER_PLANE_LARGEST);
    let steepness = length(full);
    let limited = select(full, full * (limit / max(steepness, 1e-30)), steepness > limit);
    return ReceiverPlane(clamp(uv, vec2f(0.0), vec2f(1.0)), limited, z, 1.0 / max(z - light_depth, 1e-6));
}

// A plane moved by `bias` in moment depth towards the light, as a whole: its distances from a light with rays from a point
// all shrink by the same factor. A plane through the biased depth with the unbiased gradient would be too steep, and cross
// the receiver's plane where that recedes. `bias` is less than the distance from the light.
fn receiver_plane_biased(plane: ReceiverPlane, bias: f32) -> ReceiverPlane {
    let towards = clamp(bias, -4.0, 4.0);
    let shrunk = clamp(1.0 - towards * plane.inverse_reach, 1e-6, 1e7);
    return ReceiverPlane(plane.uv, plane.gradient * shrunk, plane.depth - towards, plane.inverse_reach / shrunk);
}

// The moment depth in [-1, 1] of the plane at `offset` texels from the receiver. It is cut off at the far end, the depth of
// texels without a caster, so that these never shadow.
fn receiver_plane_depth(plane: ReceiverPlane, offset: vec2f) -> f32 {
    let rise = dot(plane.gradient, offset);
    let divisor = 1.0 - rise * plane.inverse_reach;
    let z = plane.depth + rise / max(divisor, 1e-18);
    // A ray that the plane has turned away from never meets it.
    return select(clamp(z, -1.0, 1.0), 1.0, divisor <= 0.0);
}
