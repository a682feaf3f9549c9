import super::super::maths::angle::{ANGLE_PI, angle_atan2, angle_finite, angle_of_small_tangent};

// Rectified coordinates of a camera and a directional light, in which both view rays and light rays are lines along axes.
//
// With the camera at the origin and +z the direction in which light travels, a position has a radius r = |(x, y)|, an azimuth
// phi about the light's direction, and an inclination theta to it (Peters et al., JCGT 6(1) 2017, section 7). All view rays
// of one azimuth run through a row of a map with columns r and rows phi, each at its own constant inclination; a texel (r, phi)
// is one light ray, along which theta falls. Depth along the light, -1 at the largest inclination of the frustum and 1 at the
// smallest, then serves as the depth of a shadow map whose fragments are whole view rays.

// Filled by the host-side `RectifiedFrame`.
struct RectifiedFrame {
    // The direction of the pixel at (x, y) in normalised device coordinates is x along_x + y along_y + along_middle. Divided
    // by the homogeneous coordinate of the scene, it is the pixel's position.
    along_x: vec3f,
    // The largest radius of the frustum; positive.
    largest_radius: f32,
    along_y: vec3f,
    // The azimuth of the first row, and that of the last one less the first: in (0, 2 pi].
    first_azimuth: f32,
    along_middle: vec3f,
    azimuth_extent: f32,
    // The homogeneous coordinate of the scene for clip coordinates (x, y, stored depth, 1).
    scene_w: vec4f,
    // The homogeneous coordinate at the far end: sky, and whatever is farther, counts as this far.
    farthest_w: f32,
    // The inclinations of depth 1 and -1.
    smallest_inclination: f32,
    largest_inclination: f32,
    padding: f32,
}

// A component of a position, made finite and limited so that squares do not overflow.
fn rectified_frame_component(value: f32) -> f32 {
    return clamp(angle_finite(value), -1e18, 1e18);
}

// Radius, azimuth in [-pi, pi] and inclination in [0, pi] of a position. The camera itself and non-finite components count as
// 0.
fn rectified_frame_coordinates(position: vec3f) -> vec3f {
    let x = rectified_frame_component(position.x);
    let y = rectified_frame_component(position.y);
    let z = rectified_frame_component(position.z);
    // Scaled, so that squares of small components do not vanish.
    let most = max(abs(x), abs(y));
    let scaled = vec2f(x, y) / max(most, 1e-30);
    let radius = most * sqrt(dot(scaled, scaled));
    return vec3f(radius, angle_atan2(y, x), angle_atan2(radius, z));
}

// The direction of a camera's view ray.
struct RectifiedFrameRay {
    // Radius, azimuth in [-pi, pi] and inclination in [0, pi] of the direction.
    coordinates: vec3f,
    length: f32,
}

// The view ray of a direction, with components below 1e18; below 1e-18 they count as 0. Angles are those of
// `rectified_frame_coordinates`, by the tangents of their halves: no sum cancels, and no range has to be reduced.
fn rectified_frame_view_ray(direction: vec3f) -> RectifiedFrameRay {
    let square = dot(direction.xy, direction.xy);
    let radius = sqrt(square);
    let length = sqrt(fma(direction.z, direction.z, square));
    let sums = vec2f(radius, length) + abs(direction.xz);
    let angles = 2.0 * angle_of_small_tangent(vec2f(abs(direction.y), radius) / max(sums, vec2f(1e-30)));
    let turned = select(angles, ANGLE_PI - angles, direction.xz < vec2f(0.0));
    return RectifiedFrameRay(vec3f(radius, select(turned.x, -turned.x, direction.y < 0.0), turned.y), length);
}

// The place of coordinates across the map's columns and rows, from 0 to 1. Azimuths outside the frame take its nearer end.
fn rectified_frame_place(frame: RectifiedFrame, coordinates: vec3f) -> vec2f {
    let turn = 2.0 * ANGLE_PI;
    let turned = coordinates.y - fma(0.5, frame.azimuth_extent, frame.first_azimuth);
    let from_middle = fma(-turn, round(turned * (1.0 / turn)), turned);
    return saturate(vec2f(coordinates.x / frame.largest_radius, from_middle / frame.azimuth_extent + 0.5));
}

// Radius and azimuth at a place.
fn rectified_frame_ray(frame: RectifiedFrame, place: vec2f) -> vec2f {
    return vec2f(place.x * frame.largest_radius, fma(place.y, frame.azimuth_extent, frame.first_azimuth));
}

// The depth along the light in [-1, 1] of an inclination.
fn rectified_frame_depth(frame: RectifiedFrame, inclination: f32) -> f32 {
    let extent = frame.largest_inclination - frame.smallest_inclination;
    return clamp(fma(2.0 / extent, frame.largest_inclination - inclination, -1.0), -1.0, 1.0);
}

// The inclination of a depth along the light in [-1, 1].
fn rectified_frame_inclination(frame: RectifiedFrame, depth: f32) -> f32 {
    let extent = frame.largest_inclination - frame.smallest_inclination;
    return fma(-0.5 * extent, depth + 1.0, frame.largest_inclination);
}

// The direction of a pixel at a place in normalised device coordinates.
fn rectified_frame_direction(frame: RectifiedFrame, device: vec2f) -> vec3f {
    return fma(vec3f(device.x), frame.along_x, fma(vec3f(device.y), frame.along_y, frame.along_middle));
}

// What a pixel's direction is divided by: the homogeneous coordinate of its surface, or of the point where its view ray
// reaches the far end.
fn rectified_frame_w(frame: RectifiedFrame, device: vec2f, stored_depth: f32) -> f32 {
    return max(dot(frame.scene_w, vec4f(device, stored_depth, 1.0)), frame.farthest_w);
}

// The position of a pixel's surface, or of the point where its view ray reaches the far end.
fn rectified_frame_surface(frame: RectifiedFrame, device: vec2f, stored_depth: f32) -> vec3f {
    let w = max(angle_finite(rectified_frame_w(frame, device, stored_depth)), frame.farthest_w);
    return rectified_frame_direction(frame, device) / w;
}

// The place of a row in a map of `rows` rows, from 0 to 1: the first and last rows are the ends of the frame.
fn rectified_frame_row(row: f32, rows: f32) -> f32 {
    return fma(row, rows - 1.0, 0.5) / rows;
}

// The place, from 0 to 1, of the prefix sums up to a column in a map of `columns` columns: a texel holds the sum up to its
// far edge, and is right for view rays that end at the next column's middle. So no column is counted whose middle lies beyond
// a ray's end, where what the ray ends at no longer shadows it.
fn rectified_frame_prefix(column: f32, columns: f32) -> f32 {
    return column - 1.0 / columns;
}
