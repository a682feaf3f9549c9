import super::super::moments::packed_four_moments::{packed_four_moments_nodes, packed_four_moments_sums_of_texels};

// Four moments in 32 bits: the Gauss nodes of `packed_four_moments`, each quantity rounded where shadows do not see it.
//
// Where the receiver is the farther surface, its shadow is the weight of the nearer one, whatever the depths are, as long as the upper
// node is not in front of it. So nodes move away from the light alone, which never darkens: the upper one to the next of 4096 depths,
// the lower one by rounding the distance between both down, in steps as coarse as the square root of the distance. The weight, in
// 128 steps, has the finest ones at its ends, where little of a second surface is under the filter, and is never 0 or 1: what is known of the
// spread of one surface would be lost with the other one. For the same reason the lesser weight is rounded up there, and to the nearest step
// only in the middle, so that it is never off by more than half of the widest step. The pivot is relative to the distance, so that a shape is
// rounded alike at all sizes, and is rounded up; what exceeds its last step counts as four times the root, not as less than it is.
//
// Texels are written once: a second rounding would move surfaces again.

// The numbers of steps of the four quantities, from the lowest bits up.
const COARSE_FOUR_MOMENTS_DEPTHS: f32 = 4095.0;
const COARSE_FOUR_MOMENTS_DISTANCES: f32 = 255.0;
const COARSE_FOUR_MOMENTS_WEIGHTS: f32 = 128.0;
const COARSE_FOUR_MOMENTS_PIVOTS: f32 = 31.0;

// The greatest depth from the middle of the range, in its steps.
const COARSE_FOUR_MOMENTS_LARGEST_DEPTH: f32 = 2047.5;

// Depths per square of a distance's number: 4095 / 255^2.
const COARSE_FOUR_MOMENTS_DEPTHS_PER_SQUARE: f32 = 0.06297578;

// The third power of the number of a weight's steps.
const COARSE_FOUR_MOMENTS_WHOLE: f32 = 2097152.0;

// The root of a pivot for the number 31 were the square of the distance between the nodes: 4 / (31^2 255^4).
const COARSE_FOUR_MOMENTS_ROOT_PER_SHARE: f32 = 9.844097e-13;

// The number in place of the last one where pivots are read.
const COARSE_FOUR_MOMENTS_PIVOT_BEYOND: f32 = 62.0;

// What counts as a rounding error rather than as a further step of the depth and of the distance.
const COARSE_FOUR_MOMENTS_SLACK: f32 = 0.0005;

// The texel for finite moments b.
fn coarse_four_moments_pack(b: vec4f) -> u32 {
    let nodes = packed_four_moments_nodes(b);
    let lower = clamp(nodes.lower, -1.0, 1.0);
    let upper = clamp(nodes.upper, -1.0, 1.0);
    let depth = ceil(fma(fma(0.5, upper, 0.5), COARSE_FOUR_MOMENTS_DEPTHS, -COARSE_FOUR_MOMENTS_SLACK));
    let half_distance = max(depth / COARSE_FOUR_MOMENTS_DEPTHS - fma(0.5, lower, 0.5), 0.0);
    let distance = min(floor(fma(sqrt(half_distance), COARSE_FOUR_MOMENTS_DISTANCES, COARSE_FOUR_MOMENTS_SLACK)), COARSE_FOUR_MOMENTS_DISTANCES);
    let exact = max(upper - lower, 1e-6);
    let weight = saturate((nodes.mean - lower) / exact);
    // The inverse of 3 u^2 - 2 u^3, from the middle.
    let u = -sin(asin(fma(-2.0, weight, 1.0)) / 3.0);
    // Half a step towards the middle where steps are half as wide as there, and less where they are wider.
    let inwards = clamp(10.0 * u * u * u, -0.5, 0.5);
    let share = clamp(floor(fma(u, COARSE_FOUR_MOMENTS_WEIGHTS, 0.5 * COARSE_FOUR_MOMENTS_WEIGHTS) - inwards), 0.0, COARSE_FOUR_MOMENTS_WEIGHTS - 1.0);
    // The spread of a surface is the root divided by the distance, and does not change with the latter.
    let place = distance / COARSE_FOUR_MOMENTS_DISTANCES;
    let root = sqrt(nodes.pivot) / max(exact * 2.0 * place * place, 1e-6);
    // A greater one only makes a lower bound lower.
    let pivot = min(ceil(sqrt(root) * COARSE_FOUR_MOMENTS_PIVOTS), COARSE_FOUR_MOMENTS_PIVOTS);
    let codes = vec4u(vec4f(depth, distance, share, pivot));
    return codes.x | (codes.y << 12u) | (codes.z << 20u) | (codes.w << 27u);
}

// The bilinearly filtered moments at a place in [0, 1] between four texels, in the order of a gather. Whatever the integers are, they are
// possible, and within [-1, 1] but for the fourth, which is at most 2. These are sums over eight depths, scaled once at the end.
fn coarse_four_moments_bilinear(texels: vec4u, place: vec2f) -> vec4f {
    // In steps of the depth, from the middle of the range.
    let upper = vec4f(texels & vec4u(0xfffu)) - COARSE_FOUR_MOMENTS_LARGEST_DEPTH;
    let distance = vec4f((texels >> vec4u(12u)) & vec4u(0xffu));
    let square = distance * distance;
    let lower = max(fma(vec4f(-COARSE_FOUR_MOMENTS_DEPTHS_PER_SQUARE), square, upper), vec4f(-COARSE_FOUR_MOMENTS_LARGEST_DEPTH));
    // 3 u^2 - 2 u^3 of the middle of the step, times the third power of the number of steps.
    let u = vec4f((texels >> vec4u(20u)) & vec4u(0x7fu)) + 0.5;
    let weight = u * u * fma(vec4f(-2.0), u, vec4f(3.0 * COARSE_FOUR_MOMENTS_WEIGHTS));
    let pivots = vec4f(texels >> vec4u(27u));
    let share = select(pivots, vec4f(COARSE_FOUR_MOMENTS_PIVOT_BEYOND), pivots == vec4f(COARSE_FOUR_MOMENTS_PIVOTS)) * square;
    let root = share * share;
    // The weights of texels have the sum 1 / COARSE_FOUR_MOMENTS_WHOLE, so that those of depths have the sum 1.
    let high_row = place.y * (1.0 / COARSE_FOUR_MOMENTS_WHOLE);
    let low_row = 1.0 / COARSE_FOUR_MOMENTS_WHOLE - high_row;
    let high_column = place.x * vec2f(high_row, low_row);
    let weights = vec4f(high_row - high_column.x, high_column, low_row - high_column.y);
    let of_upper = weights * weight;
    let of_lower = fma(weights, vec4f(COARSE_FOUR_MOMENTS_WHOLE), -of_upper);
    let sums = packed_four_moments_sums_of_texels(lower, upper, of_lower, of_upper);
    let one = 1.0 / COARSE_FOUR_MOMENTS_LARGEST_DEPTH;
    let two = one * one;
    let scale = COARSE_FOUR_MOMENTS_WHOLE * COARSE_FOUR_MOMENTS_ROOT_PER_SHARE * COARSE_FOUR_MOMENTS_ROOT_PER_SHARE;
    let pivot = min(dot(weights * root, root) * scale, 1.0);
    return fma(sums, vec4f(one, two, one * two, two * two), vec4f(0.0, 0.0, 0.0, pivot));
}

// The moments of a texel.
fn coarse_four_moments_unpack(texel: u32) -> vec4f {
    return coarse_four_moments_bilinear(vec4u(texel), vec2f(0.0));
}
