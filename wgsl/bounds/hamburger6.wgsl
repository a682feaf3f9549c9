import super::super::maths::hankel::{HankelFactor, hankel_factor, hankel_second_polynomial};
import super::super::moments::six_moments::{SixMoments, SixMomentsBias, six_moments_apply_bias, six_moments_bias_of, six_moments_from_texels};

// Hamburger six-moment shadow mapping: the sharpest bounds on shadow intensity that six moments allow.
//
// As with four moments the extremal distribution has the fragment depth in its support, and now three more points (Peters &
// Klein, i3D 2015, Proposition 3; six moments in Peters et al., JCGT 6(1) 2017). The published evaluation takes the three
// roots of a cubic by arc tangents and divides by its leading coefficient, which vanishes when the fragment is at a Gauss
// node. This one gives the same values without either:
//   - the weight of a support point is its Christoffel number, a sum of positive terms;
//   - how many support points lie in front of the fragment follows from the signs of the orthogonal polynomials (Sturm);
//   - since all weights add up to one, only the one point that is alone on its side is needed. In y = 1 / (z - fragment)
//     it is an extreme root of a cubic that never degenerates, and Laguerre's method finds it from outside.
//
// With x = z - b1 the monic orthogonal polynomials are P0 to P2 of `hankel`, and P3(x) = (x - offset) P2(x) - ratio x.

// The Hankel matrix of six moments, factorised.
struct Hamburger6Factor {
    // The factorised Hankel matrix of the first four moments.
    four: HankelFactor,
    // By how much x is shifted in the recurrence that makes P3.
    offset: f32,
    // One over the squared norms of P1, P2 and P3.
    inverse_norms: vec3f,
}

// P1, P2 and P3 at one place, and the same divided by their squared norms.
struct Hamburger6Polynomials {
    values: vec3f,
    coefficients: vec3f,
    // The Christoffel number 1 / (1 + P1^2 / D1 + P2^2 / D2 + P3^2 / D3).
    weight: f32,
}

// The last pivot of valid moments stays above this multiple of the moment bias alpha; that of the bias' target is 0.049.
const HAMBURGER6_SMALLEST_PIVOT: f32 = 0.004;

// The largest coefficients of the recurrence. Those of a distribution on [-1, 1] are below these, except for moments that are
// invalid or have lost all digits. The limits keep what follows from overflowing: with coefficients in these ranges and
// positive norms the polynomials are orthogonal for some distribution, so everything below holds for them too.
const HAMBURGER6_LARGEST_SHIFT: f32 = 8.0;
const HAMBURGER6_LARGEST_RATIO: f32 = 4.0;

// Support points farther out than this have a weight below 1e-8, and fragments farther out count as being there.
const HAMBURGER6_FARTHEST_SUPPORT: f32 = 1e4;

// Steps of Laguerre's method; with too few, errors of 0.1 remain in one of 10^4 cases.
const HAMBURGER6_STEPS: u32 = 6u;

// With a moment bias of at least this, fewer steps suffice.
const HAMBURGER6_LARGE_ALPHA: f32 = 1e-3;
const HAMBURGER6_STEPS_OF_LARGE_ALPHA: u32 = 4u;

// Factorises the Hankel matrix of moments biased by `alpha` >= 1e-7. Moments must lie within [-2, 2].
fn hamburger6_factor(biased: SixMoments, alpha: f32) -> Hamburger6Factor {
    let b = vec4f(biased.odd.x, biased.even.x, biased.odd.y, biased.even.y);
    var four = hankel_factor(b, alpha);
    four.shift = clamp(four.shift, -HAMBURGER6_LARGEST_SHIFT, HAMBURGER6_LARGEST_SHIFT);
    four.ratio = min(four.ratio, HAMBURGER6_LARGEST_RATIO);
    four.residue = min(four.residue, HAMBURGER6_LARGEST_RATIO * four.variance);
    let inverse = 1.0 / vec2f(four.variance, four.residue);
    // What the regressions of z^3 on 1 and z, and on 1, z and z^2, leave.
    let third = fma(-b.x, b.z, b.w);
    let third_slope = third * inverse.x;
    let fourth = fma(-fma(-b.x, b.y, b.z), third_slope, fma(-b.y, b.z, biased.odd.z));
    let fourth_slope = fourth * inverse.y;
    let pivot = fma(-fourth, fourth_slope, fma(-third, third_slope, fma(-b.z, b.z, biased.even.z)));
    let offset = fma(-3.0, b.x, fourth_slope - four.shift);
    return Hamburger6Factor(
        four,
        clamp(offset, -HAMBURGER6_LARGEST_SHIFT, HAMBURGER6_LARGEST_SHIFT),
        vec3f(inverse, 1.0 / max(pivot, HAMBURGER6_SMALLEST_PIVOT * alpha)),
    );
}

// The orthogonal polynomials and the Christoffel number at x.
fn hamburger6_polynomials(factor: Hamburger6Factor, x: f32) -> Hamburger6Polynomials {
    let second = hankel_second_polynomial(factor.four, x);
    let values = vec3f(x, second, fma(x - factor.offset, second, -factor.four.ratio * x));
    let coefficients = values * factor.inverse_norms;
    return Hamburger6Polynomials(values, coefficients, 1.0 / (1.0 + dot(values, coefficients)));
}

// The number of Gauss nodes, the roots of P3, below the place of the polynomials: the agreements of neighbours' signs.
fn hamburger6_nodes_below(polynomials: Hamburger6Polynomials) -> u32 {
    let positive = vec4<bool>(true, polynomials.values >= vec3f(0.0));
    let agree = positive.xyz == positive.yzw;
    return u32(agree.x) + u32(agree.y) + u32(agree.z);
}

// The weight of the support point that is alone on its side of a fragment at x: below it if one Gauss node is (`side` 1),
// above it if two are (`side` -1).
fn hamburger6_lone_weight(factor: Hamburger6Factor, x: f32, fragment: Hamburger6Polynomials, side: f32, alpha: f32) -> f32 {
    // The kernel sum_k P_k(x) P_k(t) / D_k, which vanishes at the support points, as a polynomial in t - x, by powers of y:
    // y^3 + e2 y^2 + e1 y + e0 with only positive terms in what it was divided by.
    let k = fragment.coefficients;
    let shift = factor.four.shift;
    let second = fma(-k.z, shift + factor.offset, k.y);
    let product = fma(factor.offset, shift, -factor.four.variance - factor.four.ratio);
    let first = fma(-k.y, shift, fma(k.z, product, k.x));
    let e2 = side * fragment.weight * fma(x, fma(3.0 * k.z, x, 2.0 * second), first);
    let e1 = fragment.weight * fma(3.0 * k.z, x, second);
    let e0 = side * fragment.weight * k.z;
    // Finds the only negative root, from a place that is left of all roots. Steps only lead towards it.
    const nearest_to_zero: f32 = -1.0 / HAMBURGER6_FARTHEST_SUPPORT;
    var y = min(-(e2 + 2.0 * sqrt(max(fma(e2, e2, -3.0 * e1), 0.0))) / 3.0, nearest_to_zero);
    let steps = select(HAMBURGER6_STEPS, HAMBURGER6_STEPS_OF_LARGE_ALPHA, alpha >= HAMBURGER6_LARGE_ALPHA);
    for (var step = 0u; step < steps; step++) {
        let value = fma(fma(y + e2, y, e1), y, e0);
        let slope = fma(fma(3.0, y, 2.0 * e2), y, e1);
        let curvature = fma(6.0, y, 2.0 * e2);
        let root = sqrt(max(fma(4.0 * slope, slope, -6.0 * value * curvature), 0.0));
        // Left of the root the sum is at least y^2, which stays above 1e-8.
        y = min(y - 3.0 * value / max(slope + root, 1e-9), nearest_to_zero);
    }
    return hamburger6_polynomials(factor, fma(side, 1.0 / y, x)).weight;
}

// The sharp bounds of shadow intensity: x = inf S(z < fragment_depth), y = sup S(z <= fragment_depth) over all
// distributions S with the moments `biased`, which are already biased by `alpha` >= 1e-7 and lie within [-2, 2].
// Both are in [0, 1] for all such moments, valid or not, and every finite fragment depth; farther out than 1e4 the
// fragment depth counts as 1e4. Error: |error| <= C * 2^-24 * (1 + sensitivity) where fma is fused, with C = 32 for alpha
// of 1e-4 and more and C = 128 for alpha about 5e-6.
fn hamburger6_bounds(biased: SixMoments, fragment_depth: f32, alpha: f32) -> vec2f {
    let factor = hamburger6_factor(biased, alpha);
    let x = clamp(fragment_depth, -HAMBURGER6_FARTHEST_SUPPORT, HAMBURGER6_FARTHEST_SUPPORT) - biased.odd.x;
    let fragment = hamburger6_polynomials(factor, x);
    let below = hamburger6_nodes_below(fragment);
    if below == 0u {
        return vec2f(0.0, fragment.weight);
    }
    if below == 3u {
        return vec2f(1.0 - fragment.weight, 1.0);
    }
    let side = select(-1.0, 1.0, below == 1u);
    let weight = hamburger6_lone_weight(factor, x, fragment, side, alpha);
    let sum = weight + fragment.weight;
    return saturate(select(vec2f(1.0 - sum, 1.0 - weight), vec2f(weight, sum), below == 1u));
}

// The lower bound of `hamburger6_bounds`, with fragment depths beyond the light's range counting as its ends.
fn hamburger6_lower_bound(biased: SixMoments, fragment_depth: f32, alpha: f32) -> f32 {
    return hamburger6_bounds(biased, clamp(fragment_depth, -1.0, 1.0), alpha).x;
}

// Shadow intensity in [0, 1] (1 = shadowed) of a fragment at `fragment_depth` (moment depth) under the filtered moments of
// its map: the lower bound, never darker than the truth except by the bias. Moments lie within [-2, 2], as those from
// `six_moments_from_texels` do, valid or not; fragment depths beyond the light's range count as its ends.
fn hamburger6_shadow_intensity(moments: SixMoments, fragment_depth: f32, bias: SixMomentsBias) -> f32 {
    return hamburger6_lower_bound(six_moments_apply_bias(moments, bias), fragment_depth, bias.alpha);
}

// Shadow intensity in [0, 1] (1 = shadowed) of a fragment under the two filtered texels of a storage, with the bias of the
// storage.
fn hamburger6_shadow_intensity_of_texels(texels: array<vec4f, 2>, fragment_depth: f32, stored_as: u32) -> f32 {
    return hamburger6_shadow_intensity(six_moments_from_texels(texels, stored_as), fragment_depth, six_moments_bias_of(stored_as));
}
