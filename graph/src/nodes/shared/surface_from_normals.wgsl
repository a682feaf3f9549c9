import moment_shadows::shade::surface_plane::{surface_plane_normal, surface_plane_steps};
import node::camera_depth::{camera_depth_clip, camera_depth_size};
import node::specialization::{GROUP, NORMALS_OCTAHEDRAL, NORMALS_UNSIGNED};

// How a pixel's surface continues, from its normal.

@group(GROUP) @binding(6) var normals: texture_2d<f32>;

// The neighbours of a pixel along x and y: xy is the step to one and z the change of stored depth. Zero without a normal.
fn surface_neighbours(pixel: vec2i, stored_depth: f32, far_depth: f32, position_from_camera: mat3x4f, scene_w_from_camera: vec4f) -> mat2x3f {
    let stored = textureLoad(normals, pixel, 0).xyz;
    let normal = surface_plane_normal(select(stored, 2.0 * stored - 1.0, NORMALS_UNSIGNED), NORMALS_OCTAHEDRAL);
    if all(normal == vec3f(0.0)) {
        return mat2x3f();
    }
    let clip = camera_depth_clip(pixel, stored_depth);
    let steps = surface_plane_steps(normal, clip, position_from_camera, scene_w_from_camera, vec2f(camera_depth_size()));
    return mat2x3f(1.0, 0.0, steps.x, 0.0, 1.0, steps.y);
}
