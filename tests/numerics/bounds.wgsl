import moment_shadows::bounds::hamburger4::{hamburger4_bounds, hamburger4_lower_bound};

struct BatchInput {
    biased: vec4f,
    depth: f32,
    alpha: f32,
    padding: vec2f,
}

// The bounds, and the lower one by the way that shading takes.
alias BatchOutput = vec4f;

fn batch(input: BatchInput) -> BatchOutput {
    let lower = hamburger4_lower_bound(input.biased, input.depth, input.alpha);
    return vec4f(hamburger4_bounds(input.biased, input.depth, input.alpha), lower, 0.0);
}
