import moment_shadows::hamburger::{hamburger_bounds};

struct BatchInput {
    biased: vec4f,
    depth: f32,
    alpha: f32,
    padding: vec2f,
}

alias BatchOutput = vec2f;

fn batch(input: BatchInput) -> BatchOutput {
    return hamburger_bounds(input.biased, input.depth, input.alpha);
}
