import moment_shadows::air::rectified_frame::{RectifiedFrame, rectified_frame_surface};
import moment_shadows::air::single_scattering::{SingleScattering};

// What every competitor is told: camera, light and medium, all in the axes of the rectified frame, whose origin is the camera.

struct ScatteringView {
    frame: RectifiedFrame,
    medium: SingleScattering,
    // The light's uv at the camera, and what it changes by along the frame's first and second axis.
    map_at_camera: vec2f,
    map_along_first: vec2f,
    map_along_second: vec2f,
    // The light's moment depth at the camera, and by how much it grows along the light.
    depth_at_camera: f32,
    depth_per_length: f32,
}

@group(0) @binding(0) var<uniform> view: ScatteringView;
@group(0) @binding(1) var camera_depth: texture_depth_2d;

@vertex
fn cover(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32(index & 1u), f32(index >> 1u));
    return vec4f(4.0 * corner - 1.0, 0.0, 1.0);
}

// From the camera to the surface of a pixel, or to the far end.
fn view_surface(pixel: vec2i) -> vec3f {
    let picture = vec2i(textureDimensions(camera_depth));
    let inside = clamp(pixel, vec2i(0), picture - 1);
    let uv = (vec2f(inside) + 0.5) / vec2f(picture);
    let device = vec2f(2.0, -2.0) * uv + vec2f(-1.0, 1.0);
    return rectified_frame_surface(view.frame, device, textureLoad(camera_depth, inside, 0));
}

// The cosine of the angle between the light's direction and a view ray.
fn view_cosine(surface: vec3f) -> f32 {
    return clamp(surface.z / max(length(surface), 1e-30), -1.0, 1.0);
}

// The mean of the colours' transmittance, as the library's node has it in alpha.
fn view_dimming(transmittance: vec3f) -> f32 {
    let others = (transmittance.y - transmittance.x) + (transmittance.z - transmittance.x);
    return fma(others, 1.0 / 3.0, transmittance.x);
}
