import node::camera_depth::{CameraPixel, CameraSurface, camera_depth_clip, camera_depth_size};
import node::neighbours::{neighbours_at};

// How a pixel's surface continues, from the camera's depth alone.

// Above every difference of stored depths.
const UNUSABLE: f32 = 1e30;

// The surface of a pixel. Stored depth is linear on the screen where a surface is plane. So along each axis the side counts whose two
// pixels, extrapolated, miss the pixel's depth by less; the other one may lie beyond a silhouette or an edge. A side whose first pixel shows
// no surface, or lies outside of the picture, says nothing. Without any the plane is unknown.
fn surface_at(at: CameraPixel, far_depth: f32, position_from_camera: mat3x4f, scene_w_from_camera: vec4f) -> CameraSurface {
    let depths = neighbours_at(at);
    let stored = vec2f(depths.stored);
    let no_before = (at.uv < at.per_pixel) | (depths.before == vec2f(far_depth));
    let no_after = (at.uv + at.per_pixel > vec2f(1.0)) | (depths.after == vec2f(far_depth));
    let miss_before = select(abs(2.0 * depths.before - depths.before_two - stored), vec2f(UNUSABLE), no_before);
    let miss_after = select(abs(2.0 * depths.after - depths.after_two - stored), vec2f(UNUSABLE), no_after);
    let change = select(depths.after - stored, stored - depths.before, miss_before < miss_after);
    // Clip space has y upwards.
    let slope = vec2f(0.5, -0.5) * change * vec2f(camera_depth_size());
    return CameraSurface(camera_depth_clip(at, depths.stored), slope, all(!no_before | !no_after));
}
