import node::map_filtering::{filtering_value};
import node::specialization::{GROUP};

// What a direction of the blur reads.

@group(GROUP) @binding(0) var moments_map: texture_2d<f32>;

// Weights that a host can change per frame.
struct BlurParameters {
    // Texels on either side of the centre.
    radius: u32,
    // Blocks of 16 taps: 2 radius + 16 taps, rounded up.
    blocks: u32,
    padding: vec2u,
    // The weights, preceded by 15 zeros and followed by zeros.
    weights: array<vec4f, 40>,
}

@group(GROUP) @binding(2) var<uniform> parameters: BlurParameters;

// A texel as it is averaged. Beyond `low` and `last`, the corners of the region, its texels repeat.
fn blur_source(texel: vec2i, low: vec2i, last: vec2i) -> vec4f {
    return filtering_value(textureLoad(moments_map, clamp(texel, low, last), 0));
}
