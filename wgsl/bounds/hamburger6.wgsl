import super::super::maths::hankel::{HankelFactor, hankel_factor, hankel_second_polynomial};
import super::super::moments::six_moments::{SixMoments, SixMomentsBias, six_moments_apply_bias, six_moments_bias_of, six_moments_biased_from_texels};

// Hamburger six-moment shadow mapping: the sharpest bounds on shadow intensity that six moments allow.
//
// As with four moments the extremal distribution has the fragment depth in its support, and now three more points (Peters &
// Klein, i3D 2015, Proposition 3; six moments in Peters et al., JCGT 6(1) 2017). The published evaluation takes the three
// roots of a cubic by arc tangents and divides by its leading coefficient, which vanishes when the fragment is at a Gauss
// node. This one gives the same values without either:
//   - the weight of a support point is its Christoffel number, a sum of positive terms;
//   - how many support points lie in front of the fragment follows from the signs of the orthogonal polynomials (Sturm);
//   - since all weights add up to one, only the one point that is alone on its side is needed. In y = 1 / (z - fragment)
//     it is an extreme root of a cubic that never degenerates: a polynomial finds its place, and Laguerre's method polishes it.
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

// Steps of Laguerre's method. From this moment bias on one is enough; with one, errors of 5e-4 were seen for 1e-5.
const HAMBURGER6_STEPS: u32 = 2u;
const HAMBURGER6_LARGE_ALPHA: f32 = 5e-5;
const HAMBURGER6_STEPS_OF_LARGE_ALPHA: u32 = 1u;

// Factorises the Hankel matrix of moments biased by `alpha` >= 3e-7. Moments must lie within [-2, 2].
fn hamburger6_factor(biased: SixMoments, alpha: f32) -> Hamburger6Factor {
    let b = vec4f(biased.odd.x, biased.even.x, biased.odd.y, biased.even.y);
    var four = hankel_factor(b, alpha);
    four.shift = clamp(four.shift, -HAMBURGER6_LARGEST_SHIFT, HAMBURGER6_LARGEST_SHIFT);
    four.residue = min(four.residue, HAMBURGER6_LARGEST_RATIO * four.variance);
    let inverse = 1.0 / vec2f(four.variance, four.residue);
    four.ratio = four.residue * inverse.x;
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
    let sum = fma(values.x, coefficients.x, fma(values.y, coefficients.y, fma(values.z, coefficients.z, 1.0)));
    return Hamburger6Polynomials(values, coefficients, 1.0 / sum);
}

// The only negative root of y^3 + e2 y^2 + e1 y + e0, whose roots are real; at most -1e-4. Relative to the middle of the roots,
// by a factor of their spread, it is at -2 cos(acos(c) / 3) with c = cos(u) in [-1, 1], which is smooth in cos(u / 2).
// From there Laguerre's method converges with the third order.
fn hamburger6_negative_root(e2: f32, e1: f32, e0: f32, steps: u32) -> f32 {
    const nearest_to_zero: f32 = -1.0 / HAMBURGER6_FARTHEST_SUPPORT;
    let middle = e2 * (-1.0 / 3.0);
    let spread_square = max(fma(middle, middle, e1 * (-1.0 / 3.0)), 1e-20);
    let spread = sqrt(spread_square);
    let at_middle = fma(fma(middle + e2, middle, e1), middle, e0);
    let half = sqrt(saturate(fma(at_middle, 0.25 / (spread * spread_square), 0.5)));
    // Off by at most 3.4e-5, to the side of roots farther out.
    let place = fma(fma(fma(fma(-0.017919, half, 0.0778), half, -0.213681), half, 1.153767), half, 1.000033);
    var y = min(fma(-spread, place, middle), nearest_to_zero);
    for (var step = 0u; step < steps; step++) {
        // Half of the second derivative, the first one, and three times the value.
        let curvature = fma(3.0, y, e2);
        let twice = curvature + e2;
        let slope = fma(twice, y, e1);
        let value = 3.0 * fma(fma(y + e2, y, e1), y, e0);
        let root = sqrt(max(fma(slope, slope, -value * curvature), 0.0));
        // Left of the root the sum is at least y^2, which stays above 1e-8.
        y = min(y - value / max(fma(2.0, root, slope), 1e-9), nearest_to_zero);
    }
    return y;
}

// The weight of the support point that is alone on its side of a fragment at x: below it if one Gauss node is (`side` 1),
// above it if two are (`side` -1).
fn hamburger6_lone_weight(factor: Hamburger6Factor, x: f32, fragment: Hamburger6Polynomials, side: f32, alpha: f32) -> f32 {
    // The kernel sum_k P_k(x) P_k(t) / D_k, which vanishes at the support points, as a polynomial in t - x, by powers of y:
    // y^3 + e2 y^2 + e1 y + e0 with only positive terms in what it was divided by.
    // These are the polynomials' derivatives, the second one halved.
    let k = fragment.coefficients;
    let second_slope = fma(2.0, x, -factor.four.shift);
    let from_offset = x - factor.offset;
    let third_slope = fma(from_offset, second_slope, fragment.values.y) - factor.four.ratio;
    let sided_weight = side * fragment.weight;
    let e2 = sided_weight * fma(k.z, third_slope, fma(k.y, second_slope, k.x));
    let e1 = fragment.weight * fma(k.z, second_slope + from_offset, k.y);
    let e0 = sided_weight * k.z;
    let steps = select(HAMBURGER6_STEPS, HAMBURGER6_STEPS_OF_LARGE_ALPHA, alpha >= HAMBURGER6_LARGE_ALPHA);
    let y = hamburger6_negative_root(e2, e1, e0, steps);
    return hamburger6_polynomials(factor, fma(side, 1.0 / y, x)).weight;
}

// Both bounds for a fragment at x = z - b1, |x| <= 1.1e4.
fn hamburger6_bounds_at(factor: Hamburger6Factor, x: f32, alpha: f32) -> vec2f {
    let fragment = hamburger6_polynomials(factor, x);
    // How many Gauss nodes, the roots of P3, lie below x is the number of agreements of neighbours' signs in 1, P1, P2, P3:
    // none or all of them if the fragment is outermost; or else one or two, as the sign of P3 tells.
    let positive = fragment.values >= vec3f(0.0);
    let outermost = positive.y && positive.x == positive.z;
    let below_most = positive.z != outermost;
    // The weight of the point that is alone on its side: at infinity, without weight, where the fragment is outermost.
    var alone = 0.0;
    if !outermost {
        alone = hamburger6_lone_weight(factor, x, fragment, select(-1.0, 1.0, below_most), alpha);
    }
    let both = saturate(alone + fragment.weight);
    return select(vec2f(1.0 - both, 1.0 - alone), vec2f(alone, both), below_most);
}

// The sharp bounds of shadow intensity: x = inf S(z < fragment_depth), y = sup S(z <= fragment_depth) over all
// distributions S with the moments `biased`, which are already biased by `alpha` >= 3e-7 and lie within [-2, 2].
// Both are in [0, 1] for all such moments, valid or not, and every finite fragment depth; farther out than 1e4 the
// fragment depth counts as 1e4. Error: |error| <= C * 2^-24 * (1 + sensitivity), measured where fma is not fused and with exact
// products in its place, with C = 32 for alpha of 5e-5 and more and C = 128 for alpha about 5e-6. Where a fragment lies within 0.05 of one
// of two surfaces that are all there is, C = 32 holds for 99 of 100 fragments; of 4,000 the worst had 58.
fn hamburger6_bounds(biased: SixMoments, fragment_depth: f32, alpha: f32) -> vec2f {
    let x = clamp(fragment_depth, -HAMBURGER6_FARTHEST_SUPPORT, HAMBURGER6_FARTHEST_SUPPORT) - biased.odd.x;
    return hamburger6_bounds_at(hamburger6_factor(biased, alpha), x, alpha);
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
    let biased = six_moments_biased_from_texels(texels, stored_as);
    return hamburger6_lower_bound(biased, fragment_depth, six_moments_bias_of(stored_as).alpha);
}
