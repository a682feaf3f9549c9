import moment_shadows::bounds::hamburger4::{hamburger4_bounds};
import moment_shadows::bounds::hausdorff4::{hausdorff4_bounds, hausdorff4_lower_bound};

struct BatchInput {
    biased: vec4f,
    depth: f32,
    alpha: f32,
    padding: vec2f,
}

struct BatchOutput {
    hausdorff: vec2f,
    hamburger: vec2f,
    // The lower bound by the way that shading takes.
    lower: f32,
    padding: f32,
}

fn batch(input: BatchInput) -> BatchOutput {
    return BatchOutput(
        hausdorff4_bounds(input.biased, input.depth, input.alpha),
        hamburger4_bounds(input.biased, clamp(input.depth, -1.0, 1.0), input.alpha),
        hausdorff4_lower_bound(input.biased, input.depth, input.alpha),
        0.0,
    );
}
