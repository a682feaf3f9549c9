import node::camera_depth::{CameraPixel, camera_depth_pixel};
import node::fullscreen::{Covered, covered_per_pixel};
import node::shade_pixel::{shade_pixel};

// Shadow intensity of every pixel, of up to four lights.

@fragment
fn shade(covered: Covered) -> @location(0) vec4f {
    let at = CameraPixel(covered.uv, covered_per_pixel(covered));
    return shade_pixel(at, camera_depth_pixel(at.uv))[0];
}
