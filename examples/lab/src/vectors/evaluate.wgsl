import moment_shadows::bounds::hamburger4::{hamburger4_bounds};
import moment_shadows::bounds::hamburger6::{hamburger6_bounds};
import moment_shadows::moments::four_moments::{FourMomentsBias, four_moments_apply_bias};
import moment_shadows::moments::six_moments::{SixMoments, SixMomentsBias, six_moments_apply_bias};

// One case of a vector file: the bounds for moments that are biased already, or after applying the bias here.
struct BatchInput {
    // The first, third and fifth moment.
    odd: vec3f,
    depth: f32,
    // The second, fourth and sixth moment; the last of both are 0 where there are four.
    even: vec3f,
    alpha: f32,
    // The even moments of the bias' target.
    target_even: vec3f,
    // 4 or 6.
    count: u32,
    // 1 if the moments are biased already.
    is_biased: u32,
    padding: array<u32, 3>,
}

struct BatchOutput {
    odd: vec3f,
    lower: f32,
    even: vec3f,
    upper: f32,
}

fn batch(input: BatchInput) -> BatchOutput {
    var biased = SixMoments(input.odd, input.even);
    var bounds: vec2f;
    if input.count == 4u {
        var b = vec4f(input.odd.x, input.even.x, input.odd.y, input.even.y);
        if input.is_biased == 0u {
            b = four_moments_apply_bias(b, FourMomentsBias(input.alpha, input.target_even.x, input.target_even.y));
        }
        biased = SixMoments(vec3f(b.xz, 0.0), vec3f(b.yw, 0.0));
        bounds = hamburger4_bounds(b, input.depth, input.alpha);
    } else {
        if input.is_biased == 0u {
            biased = six_moments_apply_bias(biased, SixMomentsBias(input.target_even, input.alpha));
        }
        bounds = hamburger6_bounds(biased, input.depth, input.alpha);
    }
    return BatchOutput(biased.odd, bounds.x, biased.even, bounds.y);
}
