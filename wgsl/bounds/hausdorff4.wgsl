import super::super::map::depth::{depth_of_fragment};
import super::super::bounds::hamburger4::{hamburger4_bounds_at, hamburger4_lower_bound_at};
import super::super::maths::hankel::{HankelFactor, hankel_factor, hankel_second_polynomial};
import super::super::moments::four_moments::{FourMomentsBias, four_moments_biased_from_texel};
import super::super::map::storage::{STORAGE_FLOAT16, STORAGE_FLOAT32, storage_finite_texel};

// Hausdorff four-moment shadow mapping: the sharpest bounds on shadow intensity that four moments allow when all depths
// are known to lie in [-1, 1].
//
// Among these fewer distributions the extremal one through the fragment is still that of the whole real line (`hamburger4`)
// if its support lies in [-1, 1]. If not, the support is -1, the fragment, 1 and one more point y (Peters & Klein, "Moment
// Shadow Mapping", i3D 2015, section 2.4; Krein & Nudelman 1977). That point follows from (1 - z^2) dS(z), which has the
// moments m_j = b_j - b_(j+2) and only the two points z_f and y: two points with given mean mu = m1/m0 and variance v, of
// which one is known.
//
// The published evaluation divides by z_f - mu. Here the weights in front of the fragment are summed before they are
// evaluated, which leaves sums of positive terms in all denominators; the support point y itself is not needed.

// The target (0, second, 0, fourth) has to lie inside the moments of distributions on [-1, 1], unlike that of `four_moments`,
// which lies on their boundary, where no bias repairs all vectors. The targets minimise the longest step that a rounding
// error needs, which is 6.14 times the error of a channel in the optimised basis and 18.4 times that of raw moments, against
// 4.88 and 9.9 for the real line. The steps alpha are those that `moment-shadows-lab bias` finds by search: they cover 99.999 %
// of filter regions. The step for float32 is longer than the 2e-6 found, with which a factorisation in f32 loses its last
// pivot in some regions.
const HAUSDORFF4_BIAS_UNORM16: FourMomentsBias = FourMomentsBias(8e-5, 0.6036, 0.4875);
const HAUSDORFF4_BIAS_FLOAT16: FourMomentsBias = FourMomentsBias(1.5e-3, 0.6036, 0.4875);
const HAUSDORFF4_BIAS_FLOAT32: FourMomentsBias = FourMomentsBias(2.8e-6, 0.4403, 0.3124);

// m0 and the Schur complement m2 - m1^2/m0 of valid biased moments stay above 0.39 and 0.11 times alpha. As in `hankel`, the
// guards act only where rounding has left no correct digit in either.
const HAUSDORFF4_SMALLEST_MASS: f32 = 0.03;
const HAUSDORFF4_SMALLEST_RESIDUE: f32 = 0.01;

// The moment bias of a storage.
fn hausdorff4_bias_of(stored_as: u32) -> FourMomentsBias {
    if stored_as == STORAGE_FLOAT32 {
        return HAUSDORFF4_BIAS_FLOAT32;
    }
    if stored_as == STORAGE_FLOAT16 {
        return HAUSDORFF4_BIAS_FLOAT16;
    }
    return HAUSDORFF4_BIAS_UNORM16;
}

// Whether the distribution on the real line through x = z - b1, where P2(x) is `polynomial`, lies in [-1, 1]. The kernel 1 +
// x t / variance + P2(x) P2(t) / residue vanishes at the other support points t, so its signs at both ends decide: both have
// to be the sign of P2(x), which the kernel has at infinity.
fn hausdorff4_contains_support(factor: HankelFactor, mean: f32, x: f32, polynomial: f32) -> bool {
    let near = -1.0 - mean;
    let far = 1.0 - mean;
    let slope = x * factor.ratio;
    let at_near = fma(polynomial, hankel_second_polynomial(factor, near), fma(slope, near, factor.residue));
    let at_far = fma(polynomial, hankel_second_polynomial(factor, far), fma(slope, far, factor.residue));
    // At a Gauss node, where P2 is 0, one of the support points is infinite: the signs at both ends differ.
    return (polynomial >= 0.0) == (at_near >= 0.0) && (polynomial >= 0.0) == (at_far >= 0.0);
}

// Both bounds from the distribution with support at both ends, for z = `fragment_depth` in [-1, 1].
fn hausdorff4_bounds_with_ends(biased: vec4f, fragment_depth: f32, alpha: f32) -> vec2f {
    // 1 - b2, b1 - b3 and b2 - b4.
    let m = vec3f(1.0, biased.xy) - biased.yzw;
    let mass = max(m.x, HAUSDORFF4_SMALLEST_MASS * alpha);
    let mean = clamp(m.y / mass, -1.0, 1.0);
    let variance = max(fma(-m.y, mean, m.z), HAUSDORFF4_SMALLEST_RESIDUE * alpha) / mass;
    let offset = fragment_depth - mean;
    let above = offset > 0.0;
    let distance = abs(offset);
    let square = offset * offset;
    // The fragment has the share variance / (variance + offset^2) of the mass, y the rest. With y = mean - variance / offset
    // on the other side of the mean, its share over the distance from y to the end beyond it is this; 0 where y is infinite.
    let inverse = mass / (variance + square);
    let room = select(1.0 + mean, 1.0 - mean, above);
    let beyond = inverse * square * distance / fma(room, distance, variance);
    let rest = select(-beyond, beyond, above);
    let at_fragment = inverse * variance;
    // In front are -1 and, if it lies in front of the fragment, y; likewise behind. Nothing lies beyond a fragment at an end: what is
    // subtracted there outweighs everything.
    let front = 1.0 - biased.x - at_fragment / max(1.0 + fragment_depth, 1e-30) + rest;
    let behind = 1.0 + biased.x - at_fragment / max(1.0 - fragment_depth, 1e-30) - rest;
    return vec2f(saturate(0.5 * front), 1.0 - saturate(0.5 * behind));
}

// The sharp bounds of shadow intensity: x = inf S(z < fragment_depth), y = sup S(z <= fragment_depth) over all
// distributions S on [-1, 1] with the moments `biased`, which are already biased by `alpha` >= 3e-7 and lie within
// [-2.1, 2.1]. Both are in [0, 1] for all such moments, valid or not; fragment depths beyond [-1, 1] count as its ends.
// Error: |error| <= 8 * 2^-24 * (1 + sensitivity), measured where fma is not fused and with exact products in its place.
fn hausdorff4_bounds(biased: vec4f, fragment_depth: f32, alpha: f32) -> vec2f {
    let depth = depth_of_fragment(fragment_depth);
    let factor = hankel_factor(biased, alpha);
    let x = depth - biased.x;
    let polynomial = hankel_second_polynomial(factor, x);
    if hausdorff4_contains_support(factor, biased.x, x, polynomial) {
        return hamburger4_bounds_at(factor, x, polynomial);
    }
    return hausdorff4_bounds_with_ends(biased, depth, alpha);
}

// The lower bound of `hausdorff4_bounds`; where it is 0 the result is below 1e-8.
fn hausdorff4_lower_bound(biased: vec4f, fragment_depth: f32, alpha: f32) -> f32 {
    let depth = depth_of_fragment(fragment_depth);
    let factor = hankel_factor(biased, alpha);
    let x = depth - biased.x;
    let polynomial = hankel_second_polynomial(factor, x);
    if hausdorff4_contains_support(factor, biased.x, x, polynomial) {
        return hamburger4_lower_bound_at(factor, x, polynomial);
    }
    return hausdorff4_bounds_with_ends(biased, depth, alpha).x;
}

// Shadow intensity in [0, 1] (1 = shadowed) of a fragment under a filtered texel of a storage, as `four_moments_to_texel`
// writes it, with the bias of the storage.
fn hausdorff4_shadow_intensity_of_texel(texel: vec4f, fragment_depth: f32, stored_as: u32) -> f32 {
    let bias = hausdorff4_bias_of(stored_as);
    let biased = four_moments_biased_from_texel(storage_finite_texel(texel, stored_as), stored_as, bias);
    return hausdorff4_lower_bound(biased, fragment_depth, bias.alpha);
}
