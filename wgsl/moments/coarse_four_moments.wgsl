import super::super::moments::packed_four_moments::{packed_four_moments_nodes, packed_four_moments_sums};

// Four moments in 32 bits: the Gauss nodes of `packed_four_moments`, each quantity rounded where shadows do not see it.
//
// Where the receiver is the farther surface, its shadow is the weight of the nearer one, whatever the depths are, as long as the upper
// node is not in front of it. So nodes move away from the light alone, which never darkens: the upper one to the next of 4096 depths,
// the lower one by rounding the distance between both down, in steps as coarse as the square root of the distance. The weight, by the nearest of
// 128 steps, has the finest ones at its ends, where little of a second surface is under the filter, and is never 0 or 1: what is known of the
// spread of one surface would be lost with the other one. The pivot is relative to the distance, so that a shape is rounded alike at all sizes,
// and is rounded up.
//
// Texels are written once: a second rounding would move surfaces again.

// The numbers of steps of the four quantities, from the lowest bits up.
const COARSE_FOUR_MOMENTS_DEPTHS: f32 = 4095.0;
const COARSE_FOUR_MOMENTS_DISTANCES: f32 = 255.0;
const COARSE_FOUR_MOMENTS_WEIGHTS: f32 = 128.0;
const COARSE_FOUR_MOMENTS_PIVOTS: f32 = 31.0;

// The greatest root of a pivot relative to the square of the distance between the nodes.
const COARSE_FOUR_MOMENTS_LARGEST_ROOT: f32 = 1.0;

// What counts as a rounding error rather than as a further step, in steps of the depth and of the distance, and of the pivot.
const COARSE_FOUR_MOMENTS_SLACK: f32 = 0.002;
const COARSE_FOUR_MOMENTS_PIVOT_SLACK: f32 = 0.05;

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
    // The inverse of 3 u^2 - 2 u^3.
    let u = 0.5 - sin(asin(clamp(fma(-2.0, weight, 1.0), -1.0, 1.0)) / 3.0);
    let share = clamp(floor(u * COARSE_FOUR_MOMENTS_WEIGHTS), 0.0, COARSE_FOUR_MOMENTS_WEIGHTS - 1.0);
    // The spread of a surface is the root divided by the distance, and does not change with the latter.
    let rounded = 2.0 * pow(distance / COARSE_FOUR_MOMENTS_DISTANCES, 2.0);
    let root = sqrt(nodes.pivot) / (exact * max(rounded, 1e-6));
    let third = pow(clamp(root / COARSE_FOUR_MOMENTS_LARGEST_ROOT, 1e-9, 1.0), 1.0 / 3.0);
    // A greater one only makes a lower bound lower.
    let pivot = ceil(fma(third, COARSE_FOUR_MOMENTS_PIVOTS, -COARSE_FOUR_MOMENTS_PIVOT_SLACK));
    let codes = vec4u(vec4f(depth, distance, share, pivot));
    return codes.x | (codes.y << 12u) | (codes.z << 20u) | (codes.w << 27u);
}

// What four texels hold.
struct CoarseFourMoments {
    lower: vec4f,
    upper: vec4f,
    // Of the upper depth, in (0, 1).
    weight: vec4f,
    pivot: vec4f,
}

fn coarse_four_moments_of_texels(texels: vec4u) -> CoarseFourMoments {
    let upper = fma(vec4f(texels & vec4u(0xfffu)), vec4f(2.0 / COARSE_FOUR_MOMENTS_DEPTHS), vec4f(-1.0));
    let place = vec4f((texels >> vec4u(12u)) & vec4u(0xffu)) * (1.0 / COARSE_FOUR_MOMENTS_DISTANCES);
    let distance = 2.0 * place * place;
    let u = (vec4f((texels >> vec4u(20u)) & vec4u(0x7fu)) + 0.5) * (1.0 / COARSE_FOUR_MOMENTS_WEIGHTS);
    let third = vec4f(texels >> vec4u(27u)) * (1.0 / COARSE_FOUR_MOMENTS_PIVOTS);
    let root = COARSE_FOUR_MOMENTS_LARGEST_ROOT * third * third * third * distance * distance;
    let weight = u * u * fma(vec4f(-2.0), u, vec4f(3.0));
    return CoarseFourMoments(max(upper - distance, vec4f(-1.0)), upper, weight, min(root * root, vec4f(1.0)));
}

// The bilinearly filtered moments at a place in [0, 1] between four texels, in the order of a gather. Whatever the integers are, they are
// possible, and within [-1, 1] but for the fourth, which is at most 2.
fn coarse_four_moments_bilinear(texels: vec4u, place: vec2f) -> vec4f {
    let held = coarse_four_moments_of_texels(texels);
    let high_column = place.x * vec2f(place.y, 1.0 - place.y);
    let weights = vec4f(place.y - high_column.x, high_column, 1.0 - place.y - high_column.y);
    let of_upper = weights * held.weight;
    let of_lower = weights - of_upper;
    var sums = packed_four_moments_sums(vec4f(0.0), vec2f(held.lower.x, held.upper.x), vec2f(of_lower.x, of_upper.x));
    sums = packed_four_moments_sums(sums, vec2f(held.lower.y, held.upper.y), vec2f(of_lower.y, of_upper.y));
    sums = packed_four_moments_sums(sums, vec2f(held.lower.z, held.upper.z), vec2f(of_lower.z, of_upper.z));
    sums = packed_four_moments_sums(sums, vec2f(held.lower.w, held.upper.w), vec2f(of_lower.w, of_upper.w));
    return sums + vec4f(0.0, 0.0, 0.0, dot(weights, held.pivot));
}

// The moments of a texel.
fn coarse_four_moments_unpack(texel: u32) -> vec4f {
    return coarse_four_moments_bilinear(vec4u(texel), vec2f(0.0));
}
