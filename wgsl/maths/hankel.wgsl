// The shared factorisation: LDL^T of the Hankel matrix of four moments.
//
//       | 1  b1 b2 |
//   B = | b1 b2 b3 |     B is positive semi-definite exactly if some distribution on the real line has these moments
//       | b2 b3 b4 |     (Hamburger moment problem; Peters & Klein, i3D 2015, section 2.2 and Algorithm 3).
//
// Its pivots define the monic orthogonal polynomials of the distribution, with x = z - b1:
//   P0 = 1,  P1(x) = x,  P2(x) = x (x - shift) - variance,
// with squared norms 1, variance and residue. The roots of P2 are the two Gauss nodes.

// The pivots of B and what the orthogonal polynomials need.
struct HankelFactor {
    // b2 - b1^2, the variance of z; positive.
    variance: f32,
    // The Schur complement of b4, the variance of z^2 that z does not explain; positive.
    residue: f32,
    // residue / variance.
    ratio: f32,
    // L32 - 2 b1, with L32 the slope of the regression of z^2 on z.
    shift: f32,
}

// Pivots of valid moments stay above these multiples of the moment bias alpha, so the guards act only where rounding has left
// no correct digit in the pivots, or where the moments are invalid. They also bound everything that is divided by a pivot:
// with alpha >= 1e-7 nothing below overflows on the way to a weight, whatever the moments.
const HANKEL_SMALLEST_VARIANCE: f32 = 0.03;
const HANKEL_SMALLEST_RESIDUE: f32 = 0.02;

// Factorises the Hankel matrix of moments biased by `alpha` >= 3e-7. Moments must lie within [-2.1, 2.1].
// The differences of products lose almost all digits near a single surface: with this alpha enough are left where `fma` is not fused,
// and more where it is.
fn hankel_factor(biased: vec4f, alpha: f32) -> HankelFactor {
    let variance = max(fma(-biased.x, biased.x, biased.y), HANKEL_SMALLEST_VARIANCE * alpha);
    // One division for all quotients.
    let inverse = 1.0 / variance;
    let covariance = fma(-biased.x, biased.y, biased.z);
    let slope = covariance * inverse;
    let residue = max(
        fma(-covariance, slope, fma(-biased.y, biased.y, biased.w)),
        HANKEL_SMALLEST_RESIDUE * alpha,
    );
    return HankelFactor(variance, residue, residue * inverse, fma(-2.0, biased.x, slope));
}

// P2 at x = z - b1. Negative exactly between the Gauss nodes.
fn hankel_second_polynomial(factor: HankelFactor, x: f32) -> f32 {
    return fma(x, x - factor.shift, -factor.variance);
}

// The Christoffel number of x = z - b1, 1 / (1 + x^2 / variance + P2^2 / residue): the largest weight that a distribution
// with these moments can have at z, which is the weight that the extremal distribution through z has there. A sum of
// positive terms, here times the residue: nothing cancels.
fn hankel_christoffel_number(factor: HankelFactor, x: f32, second_polynomial: f32) -> f32 {
    let x_term = fma(x * factor.ratio, x, factor.residue);
    return factor.residue / fma(second_polynomial, second_polynomial, x_term);
}
