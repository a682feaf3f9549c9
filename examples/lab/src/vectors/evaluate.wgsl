import moment_shadows::moments::{MomentBias, moments_apply_bias};
import moment_shadows::hamburger::{hamburger_bounds};

// One case of a vector file: the bounds for moments that are biased already, or after applying the bias here.
struct BatchInput {
    moments: vec4f,
    depth: f32,
    alpha: f32,
    // Negative: the moments are biased already.
    beta: f32,
    padding: f32,
}

struct BatchOutput {
    biased: vec4f,
    bounds: vec2f,
    padding: vec2f,
}

fn batch(input: BatchInput) -> BatchOutput {
    var biased = input.moments;
    if input.beta >= 0.0 {
        biased = moments_apply_bias(input.moments, MomentBias(input.alpha, input.beta, input.beta));
    }
    return BatchOutput(biased, hamburger_bounds(biased, input.depth, input.alpha), vec2f(0.0));
}
