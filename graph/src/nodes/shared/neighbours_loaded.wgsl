import node::camera_depth::{CameraPixel, Neighbours, camera_depth_at};

// A pixel and its neighbours, for depth with several samples per pixel, which nothing gathers.

// The depth that is stored for a pixel.
fn stored_at(at: CameraPixel) -> f32 {
    return camera_depth_at(at.pixel);
}

fn neighbours_at(at: CameraPixel) -> Neighbours {
    let pixel = at.pixel;
    let before = vec2f(camera_depth_at(pixel - vec2i(1, 0)), camera_depth_at(pixel - vec2i(0, 1)));
    let after = vec2f(camera_depth_at(pixel + vec2i(1, 0)), camera_depth_at(pixel + vec2i(0, 1)));
    let corners = vec2f(camera_depth_at(pixel - vec2i(1)), camera_depth_at(pixel + vec2i(1)));
    return Neighbours(camera_depth_at(pixel), before, after, corners);
}
