import moment_shadows::bounds::hamburger4::{hamburger4_bounds};
import moment_shadows::bounds::hamburger6::{hamburger6_bounds};
import moment_shadows::bounds::hausdorff4::{hausdorff4_bounds};
import moment_shadows::moments::four_moments::{FourMomentsBias, four_moments_apply_bias};
import moment_shadows::moments::six_moments::{SixMoments, SixMomentsBias, six_moments_apply_bias};
import moment_shadows::bounds::chebyshev::{chebyshev_lower_bound, chebyshev_upper_bound};
import moment_shadows::moments::two_moments::{two_moments_smallest_variance_of};

// One case of a vector file: the bounds for moments that are biased already, or after applying the bias here.
struct BatchInput {
    // The first, third and fifth moment.
    odd: vec3f,
    depth: f32,
    // The second, fourth and sixth moment; the last of both are 0 where there are fewer.
    even: vec3f,
    alpha: f32,
    // The even moments of the bias' target.
    target_even: vec3f,
    // 2, 4 or 6.
    count: u32,
    // 1 if the moments are biased already.
    is_biased: u32,
    // 1 for bounds over distributions on [-1, 1].
    is_hausdorff: u32,
    // The storage whose smallest variance counts, where two moments are not biased.
    stored_as: u32,
    padding: u32,
}

struct BatchOutput {
    odd: vec3f,
    lower: f32,
    even: vec3f,
    upper: f32,
    smallest_variance: f32,
    padding: array<f32, 3>,
}

// Below every variance that f32 moments leave, so that it changes none.
const NO_VARIANCE: f32 = 1e-30;

fn batch(input: BatchInput) -> BatchOutput {
    var biased = SixMoments(input.odd, input.even);
    var smallest_variance = NO_VARIANCE;
    var bounds: vec2f;
    if input.count == 2u {
        if input.is_biased == 0u {
            smallest_variance = two_moments_smallest_variance_of(input.stored_as);
        }
        let b = vec2f(input.odd.x, input.even.x);
        bounds = vec2f(chebyshev_lower_bound(b, input.depth, smallest_variance), chebyshev_upper_bound(b, input.depth, smallest_variance));
    } else if input.count == 4u {
        var b = vec4f(input.odd.x, input.even.x, input.odd.y, input.even.y);
        if input.is_biased == 0u {
            b = four_moments_apply_bias(b, FourMomentsBias(input.alpha, input.target_even.x, input.target_even.y));
        }
        biased = SixMoments(vec3f(b.xz, 0.0), vec3f(b.yw, 0.0));
        if input.is_hausdorff == 1u {
            bounds = hausdorff4_bounds(b, input.depth, input.alpha);
        } else {
            bounds = hamburger4_bounds(b, input.depth, input.alpha);
        }
    } else {
        if input.is_biased == 0u {
            biased = six_moments_apply_bias(biased, SixMomentsBias(input.target_even, input.alpha));
        }
        bounds = hamburger6_bounds(biased, input.depth, input.alpha);
    }
    return BatchOutput(biased.odd, bounds.x, biased.even, bounds.y, smallest_variance, array<f32, 3>());
}
