import super::super::maths::hankel::{HankelFactor, hankel_factor, hankel_second_polynomial, hankel_christoffel_number};
import super::super::moments::four_moments::{FourMomentsBias, four_moments_apply_bias, four_moments_bias_of, four_moments_biased_from_texel, four_moments_clamp};

// Hamburger four-moment shadow mapping: the sharpest bounds on shadow intensity that four moments allow.
//
// Among all distributions on the real line with the given moments, the share of depth in front of the fragment is
// smallest and largest for the canonical distribution that has the fragment depth and two more points as its support
// (Peters & Klein, i3D 2015, Proposition 3 and Algorithm 3). The published evaluation divides by a coefficient that
// vanishes when the fragment is at a Gauss node and takes the root of a difference that rounds below zero. This one
// gives the same values without either:
//   - the weight of a support point is its Christoffel number, a sum of positive terms;
//   - support points interlace with the Gauss nodes, so the sign of P2 tells on which side of the fragment they lie;
//   - where both sides have one, the discriminant of their quadratic is a sum of positive terms.

// Support points farther than this from the mean have a weight below 1e-8, and squaring them must not overflow.
const HAMBURGER4_FARTHEST_SUPPORT: f32 = 1e4;

// The leading coefficient stays above this, so that dividing by it is defined when the fragment is at a Gauss node.
const HAMBURGER4_SMALLEST_LEADING_COEFFICIENT: f32 = 1e-20;

// The two support points besides the fragment, relative to the mean, for a fragment at x = z - b1.
struct Hamburger4Support {
    // x_1 < x < x_2 if the fragment is between the Gauss nodes. Elsewhere finite; x_1 is then the farthest point where
    // x < 0, and without meaning where x > 0.
    points: vec2f,
    // Outside the Gauss nodes: whether x > 0.
    above: bool,
}

// The support of the extremal distribution through the fragment at x, where P2(x) is `second_polynomial`.
fn hamburger4_support(factor: HankelFactor, x: f32, second_polynomial: f32) -> Hamburger4Support {
    // -a y^2 + b y + c / 4 = 0 with a, c > 0, so both roots are real and 0 lies between them.
    let a = max(-second_polynomial, HAMBURGER4_SMALLEST_LEADING_COEFFICIENT);
    let b = fma(factor.ratio, x, factor.shift * a);
    let c = 4.0 * fma(factor.variance, a, factor.residue);
    // The roots' magnitudes are sum / (2 a) and c / (2 sum); the greater one has the sign of b. No term cancels.
    let sum = abs(b) + sqrt(fma(a, c, b * b));
    let above = b >= 0.0;
    let lower = select(sum, c, above) / select(a, sum, above);
    let upper = select(c, sum, above) / select(sum, a, above);
    let doubled = vec2f(
        max(-lower, -2.0 * HAMBURGER4_FARTHEST_SUPPORT),
        min(upper, 2.0 * HAMBURGER4_FARTHEST_SUPPORT),
    );
    return Hamburger4Support(0.5 * doubled, above);
}

// Both bounds for a fragment at x = z - b1, where P2(x) is `polynomial`.
fn hamburger4_bounds_at(factor: HankelFactor, x: f32, polynomial: f32) -> vec2f {
    if polynomial >= 0.0 {
        // Outside the Gauss nodes no support point lies beyond the fragment: no root is needed.
        let weight = saturate(hankel_christoffel_number(factor, x, polynomial));
        return select(vec2f(0.0, weight), vec2f(1.0 - weight, 1.0), x > 0.0);
    }
    let support = hamburger4_support(factor, x, polynomial).points;
    let below = hankel_christoffel_number(factor, support.x, hankel_second_polynomial(factor, support.x));
    let above = hankel_christoffel_number(factor, support.y, hankel_second_polynomial(factor, support.y));
    return saturate(vec2f(below, 1.0 - above));
}

// The lower bound for a fragment at x = z - b1, where P2(x) is `polynomial`; where the bound is 0 the result is below 1e-8.
fn hamburger4_lower_bound_at(factor: HankelFactor, x: f32, polynomial: f32) -> f32 {
    let support = hamburger4_support(factor, x, polynomial);
    // One Christoffel number serves all cases: at the fragment itself where it is above the Gauss nodes, or else at the
    // support point below it. Where the fragment is below the Gauss nodes that one is at infinity, without weight.
    let beyond = polynomial >= 0.0 && support.above;
    let t = select(support.points.x, x, beyond);
    let weight = saturate(hankel_christoffel_number(factor, t, hankel_second_polynomial(factor, t)));
    return select(weight, 1.0 - weight, beyond);
}

// The sharp bounds of shadow intensity: x = inf S(z < fragment_depth), y = sup S(z <= fragment_depth) over all
// distributions S with the moments `biased`, which are already biased by `alpha` >= 3e-7 and lie within [-2, 2].
// Both are in [0, 1] for all such moments, valid or not, and every finite fragment depth; farther out than 1e4 the
// fragment depth counts as 1e4. Error: |error| <= 8 * 2^-24 * (1 + sensitivity), measured
// where fma is not fused and with exact products in its place; with a smaller alpha rounding alone can exceed the guards near a single surface.
fn hamburger4_bounds(biased: vec4f, fragment_depth: f32, alpha: f32) -> vec2f {
    let factor = hankel_factor(biased, alpha);
    let x = clamp(fragment_depth, -HAMBURGER4_FARTHEST_SUPPORT, HAMBURGER4_FARTHEST_SUPPORT) - biased.x;
    return hamburger4_bounds_at(factor, x, hankel_second_polynomial(factor, x));
}

// The lower bound of `hamburger4_bounds`, with fragment depths beyond the light's range counting as its ends; where the bound
// is 0 the result is below 1e-8.
fn hamburger4_lower_bound(biased: vec4f, fragment_depth: f32, alpha: f32) -> f32 {
    let factor = hankel_factor(biased, alpha);
    let x = clamp(fragment_depth, -1.0, 1.0) - biased.x;
    return hamburger4_lower_bound_at(factor, x, hankel_second_polynomial(factor, x));
}

// Shadow intensity in [0, 1] (1 = shadowed) of a fragment at `fragment_depth` (moment depth) under the filtered moments of
// its map: the lower bound, never darker than the truth except by the bias. Moments may be any finite numbers; fragment
// depths beyond the light's range count as its ends.
fn hamburger4_shadow_intensity(moments: vec4f, fragment_depth: f32, bias: FourMomentsBias) -> f32 {
    return hamburger4_lower_bound(four_moments_apply_bias(four_moments_clamp(moments), bias), fragment_depth, bias.alpha);
}

// Shadow intensity in [0, 1] (1 = shadowed) of a fragment under a filtered texel of a storage, with the bias of the storage.
// Cheaper than `hamburger4_shadow_intensity`, since decoding and bias are one step and a texel of unorm storage needs no
// clamping.
fn hamburger4_shadow_intensity_of_texel(texel: vec4f, fragment_depth: f32, stored_as: u32) -> f32 {
    let bias = four_moments_bias_of(stored_as);
    return hamburger4_lower_bound(four_moments_biased_from_texel(texel, stored_as, bias), fragment_depth, bias.alpha);
}
