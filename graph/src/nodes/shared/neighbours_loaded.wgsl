import node::camera_depth::{CameraPixel, Neighbours, camera_depth_at};

// A pixel and its neighbours, for depth with several samples per pixel, which nothing gathers.

// The depth that is stored for a pixel.
fn stored_at(at: CameraPixel) -> f32 {
    return camera_depth_at(at.pixel);
}

fn neighbours_at(at: CameraPixel) -> Neighbours {
    return Neighbours(
        stored_at(at),
        vec2f(camera_depth_at(at.pixel - vec2i(1, 0)), camera_depth_at(at.pixel - vec2i(0, 1))),
        vec2f(camera_depth_at(at.pixel + vec2i(1, 0)), camera_depth_at(at.pixel + vec2i(0, 1))),
        vec2f(camera_depth_at(at.pixel - vec2i(2, 0)), camera_depth_at(at.pixel - vec2i(0, 2))),
        vec2f(camera_depth_at(at.pixel + vec2i(2, 0)), camera_depth_at(at.pixel + vec2i(0, 2))),
    );
}
