import moment_shadows::techniques::layered_variance::{LayeredVarianceLayers};
import moment_shadows::techniques::lloyd::{LloydState, lloyd_teleported};

// What becomes of an empty split.

struct BatchInput {
    layers: LayeredVarianceLayers,
    weights: array<vec4f, 2>,
    split: vec4u,
}

struct BatchOutput {
    splits: array<vec4f, 2>,
    weights: array<vec4f, 2>,
}

fn batch(input: BatchInput) -> BatchOutput {
    let state = lloyd_teleported(LloydState(input.layers, input.weights), input.split.x);
    return BatchOutput(state.layers.splits, state.weights);
}
