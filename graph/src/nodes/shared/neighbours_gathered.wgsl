import node::camera_depth::{CameraPixel, Neighbours, camera_depth, camera_sampler};

// A pixel and its neighbours in two gathers, for depth with one sample per pixel.

// The depth that is stored for a pixel.
fn stored_at(at: CameraPixel) -> f32 {
    return textureSampleLevel(camera_depth, camera_sampler, at.uv, 0);
}

// Gathers are aimed at the corners of a pixel, the middle of the four that they give: half a pixel from where rounding matters.
fn neighbours_at(at: CameraPixel) -> Neighbours {
    let before = textureGather(camera_depth, camera_sampler, at.uv - 0.5 * at.per_pixel);
    let after = textureGather(camera_depth, camera_sampler, at.uv + 0.5 * at.per_pixel);
    return Neighbours(after.w, before.xz, after.zx, vec2f(before.w, after.y));
}
