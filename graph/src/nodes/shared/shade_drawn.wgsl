import node::camera_depth::{camera_depth_size};
import node::fullscreen::{Covered};
import node::shade_pixel::{shade_pixel};

// Shadow intensity of every pixel, of up to four lights.

@fragment
fn shade(covered: Covered) -> @location(0) vec4f {
    let size = camera_depth_size();
    let pixel = clamp(vec2i(covered.uv * vec2f(size)), vec2i(0), size - 1);
    return shade_pixel(pixel, pixel)[0];
}
