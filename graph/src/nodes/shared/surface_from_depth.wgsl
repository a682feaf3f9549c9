import node::camera_depth::{camera_depth_at, camera_depth_size};

// How a pixel's surface continues, from the camera's depth alone.

// By how much the two pixels next to `pixel` along `step`, extrapolated, miss its stored depth; huge if the first one
// shows no surface or lies outside of the picture.
fn surface_extrapolation_error(pixel: vec2i, step: vec2i, stored_depth: f32, far_depth: f32) -> f32 {
    let neighbour = pixel + step;
    let outside = any(neighbour < vec2i(0)) || any(neighbour >= camera_depth_size());
    let depth = camera_depth_at(neighbour);
    let error = abs(2.0 * depth - camera_depth_at(neighbour + step) - stored_depth);
    return select(error, SURFACE_UNUSABLE, outside || depth == far_depth);
}

// Above every difference of stored depths.
const SURFACE_UNUSABLE: f32 = 1e30;

// The neighbour of a pixel along `axis` on the side that continues its surface: xy is the step to it and z the change of
// stored depth. Stored depth is linear on the screen where a surface is plane, so that is the side which extrapolates to
// the pixel best; the other one may lie beyond a silhouette or an edge. Zero without a neighbour.
fn surface_neighbour(pixel: vec2i, axis: vec2i, stored_depth: f32, far_depth: f32) -> vec3f {
    let error_before = surface_extrapolation_error(pixel, -axis, stored_depth, far_depth);
    let error_after = surface_extrapolation_error(pixel, axis, stored_depth, far_depth);
    if min(error_before, error_after) == SURFACE_UNUSABLE {
        return vec3f(0.0);
    }
    let direction = select(axis, -axis, error_before < error_after);
    return vec3f(vec2f(direction), camera_depth_at(pixel + direction) - stored_depth);
}

// The neighbours of a pixel along x and y.
fn surface_neighbours(pixel: vec2i, stored_depth: f32, far_depth: f32, position_from_camera: mat3x4f, scene_w_from_camera: vec4f) -> mat2x3f {
    return mat2x3f(
        surface_neighbour(pixel, vec2i(1, 0), stored_depth, far_depth),
        surface_neighbour(pixel, vec2i(0, 1), stored_depth, far_depth),
    );
}
