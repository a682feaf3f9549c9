import moment_shadows::shade::soft_blockers::{SoftBlockers, soft_blockers_of_four_moments, soft_blockers_of_two_moments};

struct BatchInput {
    biased: vec4f,
    depth: f32,
    alpha: f32,
    smallest_variance: f32,
    padding: f32,
}

struct BatchOutput {
    four: vec2f,
    two: vec2f,
}

fn batch(input: BatchInput) -> BatchOutput {
    let four = soft_blockers_of_four_moments(input.biased, input.depth, input.alpha);
    let two = soft_blockers_of_two_moments(input.biased.xy, input.depth, input.smallest_variance);
    return BatchOutput(vec2f(four.share, four.depth), vec2f(two.share, two.depth));
}
