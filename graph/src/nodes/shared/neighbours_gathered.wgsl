import node::camera_depth::{CameraPixel, Neighbours, camera_depth, camera_sampler};

// A pixel and its neighbours in four gathers, for depth with one sample per pixel.

// The depth that is stored for a pixel.
fn stored_at(at: CameraPixel) -> f32 {
    return textureSampleLevel(camera_depth, camera_sampler, at.uv, 0);
}

// The four pixels around a corner: that many pixels from a pixel's middle. Rounding matters half a pixel away from there.
fn gathered(at: CameraPixel, corner: vec2f) -> vec4f {
    return textureGather(camera_depth, camera_sampler, at.uv + corner * at.per_pixel);
}

fn neighbours_at(at: CameraPixel) -> Neighbours {
    let left = gathered(at, vec2f(-1.5, -0.5));
    let above = gathered(at, vec2f(-0.5, -1.5));
    let right = gathered(at, vec2f(1.5, 0.5));
    let below = gathered(at, vec2f(0.5, 1.5));
    return Neighbours(stored_at(at), vec2f(left.y, above.y), vec2f(right.w, below.w), vec2f(left.x, above.z), vec2f(right.z, below.x));
}
