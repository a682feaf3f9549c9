import moment_shadows::shade::surface_plane::{surface_plane_normal, surface_plane_slopes};
import node::camera_depth::{CameraPixel, CameraSurface, camera_depth_clip, camera_sampler};
import node::neighbours::{stored_at};
import node::specialization::{GROUP, NORMALS_OCTAHEDRAL, NORMALS_UNSIGNED};

// How a pixel's surface continues, from its normal.

@group(GROUP) @binding(6) var normals: texture_2d<f32>;

// The surface of a pixel. Its plane is unknown without a normal.
fn surface_at(at: CameraPixel, far_depth: f32, position_from_camera: mat3x4f, scene_w_from_camera: vec4f) -> CameraSurface {
    let clip = camera_depth_clip(at, stored_at(at));
    let stored = textureSampleLevel(normals, camera_sampler, at.uv, 0.0).xyz;
    var normal = select(stored, 2.0 * stored - 1.0, NORMALS_UNSIGNED);
    // What has no sign is no larger than 1 and no NaN, and planes ask for no length.
    if NORMALS_OCTAHEDRAL || !NORMALS_UNSIGNED {
        normal = surface_plane_normal(normal, NORMALS_OCTAHEDRAL);
    }
    let slope = surface_plane_slopes(normal, clip, position_from_camera, scene_w_from_camera);
    return CameraSurface(clip, slope, dot(normal, normal) >= SMALLEST_NORMAL);
}

// The square of what 8 and 10 bits make of no normal is below.
const SMALLEST_NORMAL: f32 = 1e-4;
