import moment_shadows::shade::surface_plane::{surface_plane_normal, surface_plane_slopes};
import node::camera_depth::{CameraSurface, camera_depth_at, camera_depth_clip, camera_depth_pixel};
import node::specialization::{GROUP, NORMALS_OCTAHEDRAL, NORMALS_UNSIGNED};

// How a pixel's surface continues, from its normal.

@group(GROUP) @binding(6) var normals: texture_2d<f32>;

// The surface of the pixel at a place in the picture from 0 to 1. Its plane is unknown without a normal.
fn surface_at(uv: vec2f, position_from_camera: mat3x4f, scene_w_from_camera: vec4f) -> CameraSurface {
    let pixel = camera_depth_pixel(uv);
    let clip = camera_depth_clip(pixel, camera_depth_at(pixel));
    let stored = textureLoad(normals, pixel, 0).xyz;
    let normal = surface_plane_normal(select(stored, 2.0 * stored - 1.0, NORMALS_UNSIGNED), NORMALS_OCTAHEDRAL);
    let slope = surface_plane_slopes(normal, clip, position_from_camera, scene_w_from_camera);
    return CameraSurface(clip, slope, any(normal != vec3f(0.0)));
}
