import node::camera_depth::{CameraPixel, CameraSurface, camera_depth_clip};
import node::neighbours::{neighbours_at};

// How a pixel's surface continues, from the camera's depth alone.

// Clearly better is a quarter of the other.
const CLEARLY: f32 = 0.25;

// The surface of a pixel. Stored depth is linear on the screen where a surface is plane. Along
// each axis the neighbour counts that is nearer in depth, since the other one may lie beyond a silhouette or an edge, unless the corners say
// on which side the surface is plane.
fn surface_at(at: CameraPixel, far_depth: f32, position_from_camera: mat3x4f, scene_w_from_camera: vec4f) -> CameraSurface {
    let depths = neighbours_at(at);
    // To the right and up, as clip space has it.
    let left = depths.stored - depths.before.x;
    let right = depths.after.x - depths.stored;
    let up = depths.before.y - depths.stored;
    let down = depths.stored - depths.after.y;
    // Four pixels of one plane miss it by nothing. Where one corner does so far better than the other, its pixels count.
    let miss_before = abs(depths.corners.x - depths.before.x - up);
    let miss_after = abs(depths.corners.y - depths.after.x + down);
    // Beyond the picture the pixel itself is its neighbour, and says nothing.
    let first = at.uv < at.per_pixel;
    let last = at.uv + at.per_pixel > vec2f(1.0);
    let before_is_plane = (miss_before < CLEARLY * miss_after) & !any(first);
    let after_is_plane = (miss_after < CLEARLY * miss_before) & !any(last);
    let is_nearer = vec2<bool>(abs(left) < abs(right), abs(up) < abs(down));
    let is_before = (((is_nearer & vec2<bool>(!after_is_plane)) | vec2<bool>(before_is_plane)) & !first) | last;
    let change = vec2f(select(right, left, is_before.x), select(down, up, is_before.y));
    // Nothing is known where the neighbour that is left shows no surface.
    let has_plane = all(select(depths.after, depths.before, is_before) != vec2f(far_depth));
    return CameraSurface(camera_depth_clip(at, depths.stored), 0.5 * change / at.per_pixel, has_plane);
}
