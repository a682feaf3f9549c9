// Four moments in few bits, non-linearly: what their shortest distribution consists of.
//
// Four moments are those of one distribution of two depths g1 < g2, the Gauss nodes, of which g2 has the weight w, but for the fourth
// moment, which is greater by d >= 0: the last pivot of the Hankel matrix. A texel holds the two depths, the weight and the square
// root of d. Whatever a texel holds, its moments are valid, so no bias has to cover rounding (the idea is that of Peters,
// "Non-linearly Quantized Moment Shadow Maps", HPG 2017; these quantities are not). Texels are not linear in the moments: filters
// average the moments of texels.

// The greatest number that the weight or the root has in a texel.
const PACKED_FOUR_MOMENTS_STEPS: f32 = 65535.0;

// The greatest number that a depth has there; the least is as much below 0.
const PACKED_FOUR_MOMENTS_LARGEST_DEPTH: f32 = 32767.0;

// Skewness is divided by no variance below this, so that what rounding in f32 leaves of 0 places no node far out.
const PACKED_FOUR_MOMENTS_LEAST_VARIANCE: f32 = 1e-5;

// The mean counts as no closer to an end of the range: half a unit in the last place.
const PACKED_FOUR_MOMENTS_LEAST_DISTANCE: f32 = 5.960464477539063e-8;

// What the shortest distribution with some moments consists of.
struct PackedFourMomentsNodes {
    mean: f32,
    // The two depths, within [-1, 1] but for rounding.
    lower: f32,
    upper: f32,
    // How far the fourth moment exceeds theirs, in [0, 1].
    pivot: f32,
}

// The same for finite moments b.
fn packed_four_moments_nodes(b: vec4f) -> PackedFourMomentsNodes {
    let mean = clamp(b.x, -1.0, 1.0);
    let variance = max(fma(-mean, mean, b.y), 0.0);
    let covariance = fma(-mean, b.y, b.z);
    let divisor = max(variance, PACKED_FOUR_MOMENTS_LEAST_VARIANCE);
    let pivot = saturate(fma(-covariance, covariance / divisor, fma(-b.y, b.y, b.w)));
    // The nodes relative to the mean have the product -variance and the sum s. Both lie within [-1, 1], which bounds s: were a node that
    // rounding places beyond an end clamped alone, variance would be lost, and with it up to one half of the light near the ends.
    let above_mean = max(1.0 - mean, PACKED_FOUR_MOMENTS_LEAST_DISTANCE);
    let below_mean = max(1.0 + mean, PACKED_FOUR_MOMENTS_LEAST_DISTANCE);
    let skew = max(fma(-2.0 * mean, variance, covariance) / divisor, variance / below_mean - below_mean);
    let s = min(skew, above_mean - variance / above_mean);
    // The one farther out is found without cancellation.
    let farther = 0.5 * abs(s) + sqrt(fma(0.25 * s, s, variance));
    let nearer = variance / max(farther, 1e-20);
    let above = s >= 0.0;
    let lower = mean - select(farther, nearer, above);
    let upper = mean + select(nearer, farther, above);
    return PackedFourMomentsNodes(mean, lower, upper, pivot);
}

// The channels of a packed texel for finite moments b: two depths in [-1, 1], then the weight and the root in [0, 1]. Depths are rounded outwards, so that the mean lies between them and
// the weight, found for the rounded depths, keeps it far more exactly than they are. That only widens a distribution. The lesser weight is
// rounded up and never 0: a far surface of little weight lost, or half of it, is most of the spread that moments know of.
fn packed_four_moments_channels(b: vec4f) -> vec4f {
    let nodes = packed_four_moments_nodes(b);
    let places = clamp(vec2f(nodes.lower, nodes.upper), vec2f(-1.0), vec2f(1.0)) * PACKED_FOUR_MOMENTS_LARGEST_DEPTH;
    let lower = min(floor(places.x), PACKED_FOUR_MOMENTS_LARGEST_DEPTH - 1.0);
    let upper = max(ceil(places.y), lower + 1.0);
    let steps = fma(nodes.mean, PACKED_FOUR_MOMENTS_LARGEST_DEPTH, -lower) / (upper - lower) * PACKED_FOUR_MOMENTS_STEPS;
    let is_lesser = steps < 0.5 * PACKED_FOUR_MOMENTS_STEPS;
    let weight = clamp(select(floor(steps), ceil(steps), is_lesser), 1.0, PACKED_FOUR_MOMENTS_STEPS - 1.0);
    return vec4f(vec2f(lower, upper) / PACKED_FOUR_MOMENTS_LARGEST_DEPTH, weight / PACKED_FOUR_MOMENTS_STEPS, sqrt(nodes.pivot));
}

// The moments of a packed texel with such channels.
fn packed_four_moments_from_channels(channels: vec4f) -> vec4f {
    let nodes = channels.xy;
    let squares = nodes * nodes;
    let lower = vec4f(nodes.x, squares.x, squares.x * nodes.x, squares.x * squares.x);
    let upper = vec4f(nodes.y, squares.y, squares.y * nodes.y, squares.y * squares.y);
    return fma(vec4f(channels.z), upper - lower, lower) + vec4f(0.0, 0.0, 0.0, channels.w * channels.w);
}

// Adds the moments of two depths with weights.
fn packed_four_moments_sums(before: vec4f, depths: vec2f, weights: vec2f) -> vec4f {
    let squares = depths * depths;
    let second = weights * squares;
    return vec4f(
        fma(weights.x, depths.x, fma(weights.y, depths.y, before.x)),
        before.y + (second.x + second.y),
        fma(second.x, depths.x, fma(second.y, depths.y, before.z)),
        fma(second.x, squares.x, fma(second.y, squares.y, before.w)),
    );
}

// The sum of the moments of the depths of four texels with weights.
fn packed_four_moments_sums_of_texels(lower: vec4f, upper: vec4f, of_lower: vec4f, of_upper: vec4f) -> vec4f {
    var sums = packed_four_moments_sums(vec4f(0.0), vec2f(lower.x, upper.x), vec2f(of_lower.x, of_upper.x));
    sums = packed_four_moments_sums(sums, vec2f(lower.y, upper.y), vec2f(of_lower.y, of_upper.y));
    sums = packed_four_moments_sums(sums, vec2f(lower.z, upper.z), vec2f(of_lower.z, of_upper.z));
    return packed_four_moments_sums(sums, vec2f(lower.w, upper.w), vec2f(of_lower.w, of_upper.w));
}

// The bilinearly filtered moments at a place in [0, 1] between four texels, from their first and second integers (as `storage_pack` has
// them) in the order of a gather. These are sums over eight depths, scaled once at the end.
fn packed_four_moments_bilinear(depths: vec4u, others: vec4u, place: vec2f) -> vec4f {
    let lower = vec4f(bitcast<vec4i>(depths << vec4u(16u)) >> vec4u(16u));
    let upper = vec4f(bitcast<vec4i>(depths) >> vec4u(16u));
    let root = vec4f(others >> vec4u(16u));
    // The weights of texels have the sum 1 / PACKED_FOUR_MOMENTS_STEPS, so that those of depths have the sum 1.
    let high_row = place.y * (1.0 / PACKED_FOUR_MOMENTS_STEPS);
    let low_row = 1.0 / PACKED_FOUR_MOMENTS_STEPS - high_row;
    let high_column = place.x * vec2f(high_row, low_row);
    let weights = vec4f(high_row - high_column.x, high_column, low_row - high_column.y);
    let of_upper = weights * vec4f(others & vec4u(0xffffu));
    let of_lower = fma(weights, vec4f(PACKED_FOUR_MOMENTS_STEPS), -of_upper);
    let sums = packed_four_moments_sums_of_texels(lower, upper, of_lower, of_upper);
    let one = 1.0 / PACKED_FOUR_MOMENTS_LARGEST_DEPTH;
    let two = one * one;
    let pivot = dot(weights * root, root) * (1.0 / PACKED_FOUR_MOMENTS_STEPS);
    return fma(sums, vec4f(one, two, one * two, two * two), vec4f(0.0, 0.0, 0.0, pivot));
}
