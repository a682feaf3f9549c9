import moment_shadows::techniques::layered_variance::{LayeredVarianceLayers, layered_variance_count};
import moment_shadows::techniques::lloyd::{LloydState, lloyd_contribution, lloyd_step};

// Relaxation of the splits of a map of one or two straight edges between planes.

struct BatchInput {
    layers: LayeredVarianceLayers,
    // Where the edge is: dot(normal, texel) > offset is the far side.
    normal: vec2f,
    offset: f32,
    frames: u32,
    // In front of and behind the edge, in the upper and in the lower half of the map.
    planes: vec4f,
}

struct BatchOutput {
    splits: array<vec4f, 2>,
    weights: array<vec4f, 2>,
}

const SIZE: u32 = 32u;

fn depth_at(input: BatchInput, texel: vec2u) -> f32 {
    let far = dot(input.normal, vec2f(texel)) > input.offset;
    let planes = select(input.planes.xy, input.planes.zw, texel.y >= SIZE / 2u);
    return select(planes.x, planes.y, far);
}

fn batch(input: BatchInput) -> BatchOutput {
    var state = LloydState(input.layers, array<vec4f, 2>());
    let splits = max(layered_variance_count(input.layers) - 1u, 1u);
    for (var frame = 0u; frame < input.frames; frame++) {
        let first = (2u * frame) % splits;
        var sums = vec4f(0.0);
        for (var y = 0u; y + 1u < SIZE; y++) {
            // Halves with different planes are maps of their own.
            if y + 1u == SIZE / 2u && any(input.planes.xy != input.planes.zw) {
                continue;
            }
            for (var x = 0u; x + 1u < SIZE; x++) {
                let depths = vec4f(
                    depth_at(input, vec2u(x, y)),
                    depth_at(input, vec2u(x + 1u, y)),
                    depth_at(input, vec2u(x, y + 1u)),
                    depth_at(input, vec2u(x + 1u, y + 1u)),
                );
                sums += lloyd_contribution(state.layers, first, depths);
            }
        }
        state = lloyd_step(state, first, sums);
    }
    return BatchOutput(state.layers.splits, state.weights);
}
