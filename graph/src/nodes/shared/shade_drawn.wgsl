import node::camera_depth::{camera_depth_pixel_around};
import node::fullscreen::{Covered};
import node::shade_pixel::{shade_pixel};

// Shadow intensity of every pixel, of up to four lights.

@fragment
fn shade(covered: Covered) -> @location(0) vec4f {
    let at = camera_depth_pixel_around(covered.uv);
    return shade_pixel(at, at.pixel)[0];
}
