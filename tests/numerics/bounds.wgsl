import moment_shadows::hamburger::{hamburger_bounds, hamburger_lower_bound};

struct BatchInput {
    biased: vec4f,
    depth: f32,
    alpha: f32,
    padding: vec2f,
}

// The bounds, and the lower one by the way that shading takes.
alias BatchOutput = vec4f;

fn batch(input: BatchInput) -> BatchOutput {
    let lower = hamburger_lower_bound(input.biased, input.depth, input.alpha);
    return vec4f(hamburger_bounds(input.biased, input.depth, input.alpha), lower, 0.0);
}
