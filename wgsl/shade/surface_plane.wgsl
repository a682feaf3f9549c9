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

// How stored depth changes with x and y of clip space on a surface's plane, each within [-1e4, 1e4].
//
// `clip` is the surface in the camera's clip space, (x, y, stored depth, 1); `position_from_clip`, by rows, gives its position
// relative to the camera times a coordinate that `w_from_clip` gives; `normal`, of any length, has the axes of that position. A
// plane dot(normal, position) = d in space is a plane in clip space too, across which stored depth is linear. One that the camera
// sees edge-on changes by the most.
fn surface_plane_slopes(normal: vec3f, clip: vec4f, position_from_clip: mat3x4f, w_from_clip: vec4f) -> vec2f {
    let across = position_from_clip * normal;
    let d = dot(across, clip) * (1.0 / max(dot(w_from_clip, clip), 1e-30));
    let plane = across.xyz - d * w_from_clip.xyz;
    let divisor = select(min(-plane.z, -1e-30), max(-plane.z, 1e-30), plane.z < 0.0);
    return clamp(plane.xy / divisor, vec2f(-1e4), vec2f(1e4));
}
