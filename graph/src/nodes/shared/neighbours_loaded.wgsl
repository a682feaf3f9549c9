import node::camera_depth::{CameraPixel, Neighbours, camera_depth_at, camera_depth_pixel};

// A pixel and its neighbours, for depth with several samples per pixel, which nothing gathers.

// The depth that is stored for the pixel around a place in the picture from 0 to 1.
fn stored_at(uv: vec2f) -> f32 {
    return camera_depth_at(camera_depth_pixel(uv));
}

fn neighbours_at(at: CameraPixel) -> Neighbours {
    let pixel = camera_depth_pixel(at.uv);
    let before = vec2f(camera_depth_at(pixel - vec2i(1, 0)), camera_depth_at(pixel - vec2i(0, 1)));
    let after = vec2f(camera_depth_at(pixel + vec2i(1, 0)), camera_depth_at(pixel + vec2i(0, 1)));
    let corners = vec2f(camera_depth_at(pixel - vec2i(1)), camera_depth_at(pixel + vec2i(1)));
    return Neighbours(camera_depth_at(pixel), before, after, corners);
}
