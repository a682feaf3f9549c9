import node::specialization::{CAMERA_SAMPLE, CameraDepth, GROUP};

// The camera's depth: where surfaces are. Of several samples of a pixel the first one counts, at its own place.

@group(GROUP) @binding(1) var camera_depth: CameraDepth;
// Takes the nearest texel.
@group(GROUP) @binding(11) var camera_sampler: sampler;

// A pixel: its number, its middle in the picture from 0 to 1, and how far it is to those beside and below.
struct CameraPixel {
    pixel: vec2i,
    uv: vec2f,
    per_pixel: vec2f,
}

// A pixel's surface.
struct CameraSurface {
    // Its place in the camera's clip space: x, y, stored depth and 1.
    clip: vec4f,
    // How its stored depth changes with x and y, along its plane.
    slope: vec2f,
    // Whether that plane is known.
    has_plane: bool,
}

// The depth that is stored for a pixel and its neighbours; beyond the picture that of the nearest pixel.
struct Neighbours {
    stored: f32,
    // To the left and above, and to the right and below.
    before: vec2f,
    after: vec2f,
    // Two pixels that way.
    before_two: vec2f,
    after_two: vec2f,
}

// Width and height of the picture.
fn camera_depth_size() -> vec2i {
    return vec2i(textureDimensions(camera_depth));
}

// A pixel by its number.
fn camera_depth_pixel(pixel: vec2i) -> CameraPixel {
    let per_pixel = 1.0 / vec2f(camera_depth_size());
    return CameraPixel(pixel, (vec2f(pixel) + 0.5) * per_pixel, per_pixel);
}

// The pixel around a place in the picture, from 0 to below 1. A host may show the picture in a viewport of another size.
fn camera_depth_pixel_around(uv: vec2f) -> CameraPixel {
    let size = vec2f(camera_depth_size());
    let middle = floor(uv * size) + 0.5;
    let per_pixel = 1.0 / size;
    return CameraPixel(vec2i(middle), middle * per_pixel, per_pixel);
}

// The depth that is stored for a pixel; beyond the picture for the nearest one.
fn camera_depth_at(pixel: vec2i) -> f32 {
    return textureLoad(camera_depth, clamp(pixel, vec2i(0), camera_depth_size() - 1), 0);
}

// A pixel's surface in the camera's clip space: x, y, stored depth and 1.
fn camera_depth_clip(at: CameraPixel, stored_depth: f32) -> vec4f {
    var sample = 2.0 * at.uv;
    if any(CAMERA_SAMPLE != vec2f(0.5)) {
        // Rounded once: bilinear weights jump where a place lies between two of them.
        sample = 2.0 * (vec2f(at.pixel) + CAMERA_SAMPLE) / vec2f(camera_depth_size());
    }
    return vec4f(sample.x - 1.0, 1.0 - sample.y, stored_depth, 1.0);
}
