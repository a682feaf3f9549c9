import super::super::map::depth::{depth_is_nan};

// The plane of a surface on the camera's screen, from its normal.

// The unit vector of a normal as textures hold it: three components of a vector of any length, or in `stored.xy` the octahedron
// folded open, from -1 to 1 (Meyer et al., "On Floating-Point Normal Vectors", EGSR 2010, section 3). Zero for a vector without direction, as
// where no surface is, and for NaN.
fn surface_plane_normal(stored: vec3f, octahedral: bool) -> vec3f {
    // Squares are finite.
    var normal = clamp(stored, vec3f(-1e9), vec3f(1e9));
    if octahedral {
        normal.z = 1.0 - abs(normal.x) - abs(normal.y);
        let folded = max(-normal.z, 0.0);
        normal.x += select(folded, -folded, normal.x >= 0.0);
        normal.y += select(folded, -folded, normal.y >= 0.0);
    }
    let square = dot(normal, normal);
    return select(normal * inverseSqrt(max(square, 1e-6)), vec3f(0.0), square < 1e-6 || depth_is_nan(square));
}

// How stored depth changes on a surface's plane from a pixel to the pixels to its right and below, each in [-1, 1].
//
// `clip` is the surface in the camera's clip space, (x, y, stored depth, 1); `position_from_clip`, by rows, gives its position
// relative to the camera times a coordinate that `w_from_clip` gives; `normal` has the axes of that position. A plane
// dot(normal, position) = d in space is a plane in clip space too, across which stored depth is linear. `size` is that of the
// picture in pixels. A plane that the camera sees edge-on changes by 1.
fn surface_plane_steps(normal: vec3f, clip: vec4f, position_from_clip: mat3x4f, w_from_clip: vec4f, size: vec2f) -> vec2f {
    let w = max(dot(w_from_clip, clip), 1e-30);
    let d = dot(normal, clip * position_from_clip / w);
    let plane = position_from_clip * normal - d * w_from_clip;
    let divisor = select(max(plane.z, 1e-30), min(plane.z, -1e-30), plane.z < 0.0);
    return clamp(vec2f(-2.0, 2.0) * plane.xy / (divisor * max(size, vec2f(1.0))), vec2f(-1.0), vec2f(1.0));
}
