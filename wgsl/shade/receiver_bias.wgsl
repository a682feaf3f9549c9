// Receiver bias: how far the fragment depth moves towards the light so that a surface does not shadow itself.
//
// Not to be confused with the moment bias, which belongs to storage. A plane tilted against the light fills the filter
// kernel with depths whose standard deviation is
//   (the kernel's standard deviation in texels) x (change of depth per texel).
// The lower bound of four moments is exactly 0 for fragments in front of the lower Gauss node, which for a symmetric
// distribution lies one standard deviation in front of the mean. So a slope-scaled bias of somewhat more than one
// standard deviation removes self-shadowing on planes, and nothing about it has to be tuned to a scene.

// How many standard deviations of depth under the filter a receiver moves: one, and more to cover moment bias and rounding.
const RECEIVER_BIAS_STANDARD_DEVIATIONS: f32 = 1.25;

// A gradient steeper than that of any surface that a light sees; its square is still finite.
const RECEIVER_BIAS_EDGE_ON: f32 = 1e15;

// Filled by the host-side `ReceiverBias`.
struct ReceiverBias {
    // Moment depth that is always subtracted.
    constant: f32,
    // Multiplies the length of the gradient of moment depth per texel: the kernel's standard deviation in texels, times
    // a safety factor slightly above 1.
    slope_scale: f32,
    // The largest bias in moment depth; reached where the surface is seen edge-on by the light.
    maximum: f32,
    // Two numbers a and b as halves of 16-bit snorms: one step of the light's stored depth is (a + b z)^2 of moment depth at the
    // moment depth z. It is the same everywhere for linear depth, and for hyperbolic depth grows with the square of the distance.
    step: u32,
}

// What arithmetic in single precision loses of a moment depth at most, beside what is stored.
const RECEIVER_BIAS_ROUNDING: f32 = 4.76837158203125e-7;

// The bias in moment depth of a fitted range (`range_fit`), of which the host's range has `scale` times the length. The host's
// slopes, and with them the largest bias, become that many times as steep. The constant is what moment depths themselves are off
// by, whatever their range; only the rounding error of the host's moment depth grows.
fn receiver_bias_fitted(bias: ReceiverBias, scale: f32) -> ReceiverBias {
    let constant = fma(scale - 1.0, RECEIVER_BIAS_ROUNDING, bias.constant);
    return ReceiverBias(constant, bias.slope_scale, fma(scale, bias.maximum - bias.constant, constant), bias.step);
}

// The gradient of moment depth per texel on the receiver's plane, from the differences of two neighbouring points on it
// in light space: xy in texels of the map, z in moment depth, each at most 1e9. Where the differences in xy are parallel
// or zero (the plane is edge-on to the light, or a neighbour is missing) the result is huge, and `receiver_bias_depth`
// limits it.
fn receiver_bias_plane(difference_x: vec3f, difference_y: vec3f) -> vec2f {
    let determinant = difference_x.x * difference_y.y - difference_x.y * difference_y.x;
    if abs(determinant) < 1e-20 {
        return vec2f(RECEIVER_BIAS_EDGE_ON, 0.0);
    }
    // Cramer's rule for the gradient g in dot(g, difference.xy) = difference.z.
    let scaled = vec2f(
        difference_x.z * difference_y.y - difference_y.z * difference_x.y,
        difference_y.z * difference_x.x - difference_x.z * difference_y.x,
    );
    return clamp(scaled / determinant, vec2f(-RECEIVER_BIAS_EDGE_ON), vec2f(RECEIVER_BIAS_EDGE_ON));
}

// What a fragment depth loses to how coarsely the light's depth is stored: one step of it at that depth, half of which a stored
// depth is off by; the other half is for the variance that steps add under a kernel. To be subtracted from the fragment depth
// before anything else.
fn receiver_bias_step(bias: ReceiverBias, fragment_depth: f32) -> f32 {
    let halves = unpack2x16snorm(bias.step);
    let half_root = fma(halves.y, clamp(fragment_depth, -1.0, 1.0), halves.x);
    return min(4.0 * half_root * half_root, 2.0);
}

// The receiver bias in moment depth, to be subtracted from the fragment depth.
fn receiver_bias_depth(bias: ReceiverBias, gradient: f32) -> f32 {
    return clamp(fma(bias.slope_scale, gradient, bias.constant), 0.0, bias.maximum);
}

// The receiver bias where a lookup averages more of the map than its filter kernel: `variance` is what this adds to the
// variance of the depths of a plane with that gradient (`minification_depth_variance`). Variances of filters add up.
fn receiver_bias_depth_minified(bias: ReceiverBias, gradient: f32, variance: f32) -> f32 {
    let kernel = bias.slope_scale * gradient;
    let added = (RECEIVER_BIAS_STANDARD_DEVIATIONS * RECEIVER_BIAS_STANDARD_DEVIATIONS) * max(variance, 0.0);
    let deviation = sqrt(fma(kernel, kernel, added));
    // The slope is limited, not the depth: a filter that is wider by a factor may move the receiver farther by that factor.
    let limit = (bias.maximum - bias.constant) / max(kernel, 1e-30);
    return max(fma(deviation, clamp(limit, 0.0, 1.0), bias.constant), 0.0);
}

// The part of the bias that grows with the slope, under a kernel with the standard deviation `deviation` in texels along x
// and y, on a plane with the gradient `gradient` of moment depth per texel, which counts up to the length `steepest`.
fn receiver_bias_depth_of_kernel(gradient: vec2f, deviation: vec2f, steepest: f32) -> f32 {
    let full = clamp(gradient, vec2f(-RECEIVER_BIAS_EDGE_ON), vec2f(RECEIVER_BIAS_EDGE_ON));
    let steepness = length(full);
    let limited = full * min(max(steepest, 0.0) / max(steepness, 1e-30), 1.0);
    return RECEIVER_BIAS_STANDARD_DEVIATIONS * length(limited * deviation);
}
