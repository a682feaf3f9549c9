//! An experiment on rounding: what the robust evaluation gives where `fma` rounds once, and where it rounds twice.
//!
//! WGSL leaves it to the device whether `fma` is fused, and one adapter shows one behaviour only. This repeats the evaluation of
//! the shader in f32 with either. It is a transcription by nature, so it says nothing about correctness; it shows what the
//! two kinds of devices make of the same arithmetic.

/// How `a * b + c` is rounded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fma {
    /// Once, as a fused operation.
    Fused,
    /// Twice: after the product and after the sum.
    Separate,
}

impl Fma {
    pub(super) fn apply(self, a: f32, b: f32, c: f32) -> f32 {
        match self {
            Fma::Fused => a.mul_add(b, c),
            Fma::Separate => a * b + c,
        }
    }
}

/// The (lower, upper) bounds for moments biased by `alpha`, as f32 arithmetic gives them.
#[must_use]
pub fn bounds_in_f32(biased: [f32; 4], fragment_depth: f32, alpha: f32, fma: Fma) -> [f32; 2] {
    let [b1, b2, b3, b4] = biased;
    let variance = fma.apply(-b1, b1, b2).max(0.03 * alpha);
    let covariance = fma.apply(-b1, b2, b3);
    let slope = (covariance / variance).clamp(-4.0, 4.0);
    let residue = fma
        .apply(-covariance, slope, fma.apply(-b2, b2, b4))
        .max(0.02 * alpha);
    let shift = fma.apply(-2.0, b1, slope);
    let x = fragment_depth.clamp(-1e4, 1e4) - b1;
    let second = |x: f32| fma.apply(x, x - shift, -variance);
    let christoffel = |x: f32| {
        let second = second(x);
        let norm = variance * residue;
        norm / (norm + x * x * residue + second * second * variance)
    };
    let polynomial = second(x);
    if polynomial >= 0.0 {
        let weight = christoffel(x);
        return if x > 0.0 {
            [1.0 - weight, 1.0]
        } else {
            [0.0, weight]
        };
    }
    let a = polynomial.min(-1e-20);
    let b = fma.apply(residue / variance, x, -shift * a);
    let c = fma.apply(-variance, a, residue);
    let root = fma.apply(b, b, -4.0 * a * c).max(0.0).sqrt();
    let q = -0.5 * (b + if b >= 0.0 { root } else { -root });
    let roots = [(q / a).clamp(-1e4, 1e4), (c / q).clamp(-1e4, 1e4)];
    let below = christoffel(roots[0].min(roots[1]));
    let above = christoffel(roots[0].max(roots[1]));
    [below.clamp(0.0, 1.0), (1.0 - above).clamp(0.0, 1.0)]
}
