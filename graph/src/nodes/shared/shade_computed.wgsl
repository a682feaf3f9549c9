import node::camera_depth::{CameraPixel, camera_depth_size};
import node::shade_pixel::{shade_pixel};
import node::shade_targets::{shade_store};
import node::specialization::{SHADED};

// Shadow intensity of every pixel, of more lights than a target has channels: one pixel per invocation.

@compute @workgroup_size(SHADED, SHADED)
fn shade(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup: vec3u) {
    let first = SHADED * vec2i(workgroup.xy);
    let pixel = first + vec2i(local.xy);
    let size = camera_depth_size();
    if all(pixel < size) {
        let per_pixel = 1.0 / vec2f(size);
        shade_store(pixel, shade_pixel(CameraPixel((vec2f(pixel) + 0.5) * per_pixel, per_pixel), first));
    }
}
