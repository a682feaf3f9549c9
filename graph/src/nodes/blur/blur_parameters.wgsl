import node::specialization::{GROUP};

// Weights of a blur that a host can change per frame.

struct BlurParameters {
    // Texels on either side of the centre.
    radius: u32,
    // Blocks of 16 taps: 2 radius + OUTPUTS taps, rounded up.
    blocks: u32,
    padding: vec2u,
    // The weights, preceded by 15 zeros and followed by zeros.
    weights: array<vec4f, 40>,
}

@group(GROUP) @binding(2) var<uniform> parameters: BlurParameters;
