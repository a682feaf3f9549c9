import super::hankel::{HankelFactor, hankel_factor, hankel_second_polynomial, hankel_christoffel_number};
import super::moments::{MomentBias, moments_apply_bias, moments_clamp};

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
const HAMBURGER_FARTHEST_SUPPORT: f32 = 1e4;

// The leading coefficient stays below this, so that dividing by it is defined when the fragment is at a Gauss node.
const HAMBURGER_LARGEST_LEADING_COEFFICIENT: f32 = -1e-20;

// The two support points besides the fragment, relative to the mean, in order, for a fragment at x = z - b1 between the
// Gauss nodes: x_1 < x < x_2. Elsewhere the result is finite and without meaning.
fn hamburger_support(factor: HankelFactor, x: f32, second_polynomial: f32) -> vec2f {
    // a y^2 + b y + c = 0 with a < 0 < c, so both roots are real and 0 lies between them.
    let a = min(second_polynomial, HAMBURGER_LARGEST_LEADING_COEFFICIENT);
    let b = fma(factor.residue / factor.variance, x, -factor.shift * a);
    let c = fma(-factor.variance, a, factor.residue);
    // sign(0) is 0 and would lose both roots.
    let q = -0.5 * (b + select(-1.0, 1.0, b >= 0.0) * sqrt(max(fma(b, b, -4.0 * a * c), 0.0)));
    let roots = clamp(
        vec2f(q / a, c / q),
        vec2f(-HAMBURGER_FARTHEST_SUPPORT),
        vec2f(HAMBURGER_FARTHEST_SUPPORT),
    );
    return vec2f(min(roots.x, roots.y), max(roots.x, roots.y));
}

// The sharp bounds of shadow intensity: x = inf S(z < fragment_depth), y = sup S(z <= fragment_depth) over all
// distributions S with the moments `biased`, which are already biased by `alpha` > 0 and lie within [-2, 2].
// Both are in [0, 1] for all such moments, valid or not, and every finite fragment depth; farther out than 1e4 the
// fragment depth counts as 1e4. Error: |error| <= 8 * 2^-24 * (1 + sensitivity) where fma is fused.
fn hamburger_bounds(biased: vec4f, fragment_depth: f32, alpha: f32) -> vec2f {
    let factor = hankel_factor(biased, alpha);
    let x = clamp(fragment_depth, -HAMBURGER_FARTHEST_SUPPORT, HAMBURGER_FARTHEST_SUPPORT) - biased.x;
    let polynomial = hankel_second_polynomial(factor, x);
    if polynomial >= 0.0 {
        // Outside the Gauss nodes no support point lies beyond the fragment: no root is needed.
        let weight = hankel_christoffel_number(factor, x, polynomial);
        return select(vec2f(0.0, weight), vec2f(1.0 - weight, 1.0), x > 0.0);
    }
    let support = hamburger_support(factor, x, polynomial);
    let below = hankel_christoffel_number(factor, support.x, hankel_second_polynomial(factor, support.x));
    let above = hankel_christoffel_number(factor, support.y, hankel_second_polynomial(factor, support.y));
    return saturate(vec2f(below, 1.0 - above));
}

// Shadow intensity in [0, 1] (1 = shadowed) of a fragment at `fragment_depth` (moment depth) under the filtered moments
// of its map: the lower bound, never darker than the truth but for the bias. Moments may be anything finite; fragment
// depths beyond the light's range count as its ends.
fn hamburger_shadow_intensity(moments: vec4f, fragment_depth: f32, bias: MomentBias) -> f32 {
    let biased = moments_apply_bias(moments_clamp(moments), bias);
    let factor = hankel_factor(biased, bias.alpha);
    let x = clamp(fragment_depth, -1.0, 1.0) - biased.x;
    let polynomial = hankel_second_polynomial(factor, x);
    let outside = polynomial >= 0.0;
    // One Christoffel number serves both cases: at the fragment itself, or at the support point in front of it.
    let support = hamburger_support(factor, x, polynomial).x;
    let t = select(support, x, outside);
    let weight = hankel_christoffel_number(factor, t, hankel_second_polynomial(factor, t));
    return saturate(select(weight, select(0.0, 1.0 - weight, x > 0.0), outside));
}
