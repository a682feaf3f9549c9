//! An experiment on rounding: what the robust evaluation gives on a device that does not fuse multiply and add.
//!
//! WGSL leaves it to the device whether `fma` rounds once or twice, and an adapter that contracts `a * b + c` on its own
//! cannot show the other behaviour. This repeats the evaluation of the shader in f32 with every operation rounded. It is a
//! transcription by nature, so it says nothing about correctness; it shows that the guards keep the result in range.

/// The (lower, upper) bounds as f32 arithmetic without fused operations gives them.
#[must_use]
pub fn bounds_without_fma(biased: [f32; 4], fragment_depth: f32, alpha: f32) -> [f32; 2] {
    let [b1, b2, b3, b4] = biased;
    let variance = (b2 - b1 * b1).max(0.03 * alpha);
    let covariance = b3 - b1 * b2;
    let slope = (covariance / variance).clamp(-4.0, 4.0);
    let residue = ((b4 - b2 * b2) - covariance * slope).max(0.02 * alpha);
    let shift = slope - 2.0 * b1;
    let x = fragment_depth.clamp(-1e4, 1e4) - b1;
    let second = |x: f32| x * (x - shift) - variance;
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
    let b = residue / variance * x - shift * a;
    let c = residue - variance * a;
    let root = (b * b - 4.0 * a * c).max(0.0).sqrt();
    let q = -0.5 * (b + if b >= 0.0 { root } else { -root });
    let roots = [(q / a).clamp(-1e4, 1e4), (c / q).clamp(-1e4, 1e4)];
    let below = christoffel(roots[0].min(roots[1]));
    let above = christoffel(roots[0].max(roots[1]));
    [below.clamp(0.0, 1.0), (1.0 - above).clamp(0.0, 1.0)]
}
