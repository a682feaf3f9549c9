import node::camera_depth::{camera_depth_pixel, camera_depth_size};
import node::shade_pixel::{shade_pixel};
import node::shade_targets::{shade_store};
import node::specialization::{SHADED};

// Shadow intensity of every pixel, of more lights than a target has channels: one pixel per invocation.

@compute @workgroup_size(SHADED, SHADED)
fn shade(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup_id: vec3u) {
    let first = SHADED * vec2i(workgroup_id.xy);
    let pixel = first + vec2i(local.xy);
    if all(pixel < camera_depth_size()) {
        shade_store(pixel, shade_pixel(camera_depth_pixel(pixel), first));
    }
}
