import moment_shadows::bounds::hamburger6::{hamburger6_bounds, hamburger6_lower_bound, hamburger6_shadow_intensity_of_texels};
import moment_shadows::moments::six_moments::{SixMoments};
import moment_shadows::map::storage::{STORAGE_FLOAT32};

struct BatchInput {
    odd: vec3f,
    depth: f32,
    even: vec3f,
    alpha: f32,
}

// The bounds, the lower one by the way that shading takes, and the moments as channels of texels.
alias BatchOutput = vec4f;

fn batch(input: BatchInput) -> BatchOutput {
    let biased = SixMoments(input.odd, input.even);
    let texels = array<vec4f, 2>(vec4f(input.odd, 1.0), vec4f(input.even, 1.0));
    return vec4f(
        hamburger6_bounds(biased, input.depth, input.alpha),
        hamburger6_lower_bound(biased, input.depth, input.alpha),
        hamburger6_shadow_intensity_of_texels(texels, input.depth, STORAGE_FLOAT32),
    );
}
