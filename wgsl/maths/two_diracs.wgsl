// Two weighted depths that have three given moments: they stand for a filtered texel of a shadow map when it is resampled.
//
// There is exactly one such pair (Peters et al., supplement of "Beyond Hard Shadows", i3D 2016, theorem 1). Relative to the
// mean, with c the variance and d half of the regression slope's excess, the depths are d -+ sqrt(d^2 + c): nothing cancels,
// unlike in the published form, which takes the root of a difference.

// Two depths and their weights, which sum to one.
struct TwoDiracs {
    // In rising order.
    depths: vec2f,
    // Not negative.
    weights: vec2f,
}

// The smallest variance: rounding of f32 moments leaves no digit of it. Smaller ones count as this, which moves moments by as
// much.
const TWO_DIRACS_SMALLEST_VARIANCE: f32 = 1e-7;

// Two weighted depths with the moments b1, b2, b3 of depths in [-1, 1]. Invalid moments, if they are finite, give finite
// depths, which may lie outside [-1, 1].
fn two_diracs_of_moments(moments: vec3f) -> TwoDiracs {
    let b = clamp(moments, vec3f(-1.0, 0.0, -1.0), vec3f(1.0));
    let variance = max(fma(-b.x, b.x, b.y), TWO_DIRACS_SMALLEST_VARIANCE);
    let d = 0.5 * fma(-b.x, b.y, b.z) / variance - b.x;
    let root = sqrt(fma(d, d, variance));
    let sum = abs(d) + root;
    // The depth on the side of d is farther from the mean, and has the smaller weight.
    let near = variance / sum;
    let small = 0.5 * near / root;
    let low = select(vec2f(-sum, small), vec2f(-near, 1.0 - small), d >= 0.0);
    let high = select(vec2f(near, 1.0 - small), vec2f(sum, small), d >= 0.0);
    return TwoDiracs(b.x + vec2f(low.x, high.x), vec2f(low.y, high.y));
}
