import node::specialization::{GROUP};

// What maps say of a pixel's shadow.

@group(GROUP) @binding(2) var intensity: texture_2d<f32>;

fn intensity_at(pixel: vec2i) -> vec4f {
    return textureLoad(intensity, pixel, 0);
}
