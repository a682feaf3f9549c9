// View rays of a perspective camera, relative to it.

// The largest length of a ray.
const VIEW_RAY_LONGEST: f32 = 1e9;

struct ViewRay {
    // Of length 1.
    direction: vec3f,
    // Up to the surface, or up to where the ray reaches the far end.
    length: f32,
}

// The view ray of a pixel at a place in clip space: x, y, stored depth and 1. By rows, `position_from_camera` gives a position
// times the scene's homogeneous coordinate, which `scene_w_from_camera` gives; at the far end that is `farthest_w`.
fn view_ray_of_pixel(position_from_camera: mat3x4f, scene_w_from_camera: vec4f, farthest_w: f32, clip: vec4f) -> ViewRay {
    let along = clip * position_from_camera;
    let length = sqrt(dot(along, along));
    let w = max(dot(scene_w_from_camera, clip), farthest_w);
    return ViewRay(along / max(length, 1e-30), min(length / max(w, 1e-30), VIEW_RAY_LONGEST));
}
