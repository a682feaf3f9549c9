//! Exact bounds of a vector's moments, and the unit in which a shader's errors are counted.

use dashu::rational::RBig;

use crate::oracle::{
    Extremal, OracleError, hamburger, hausdorff, rational, sensitivity, tolerance_unit,
};

/// Which distributions bounds are taken over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Bound {
    /// Distributions on the real line.
    Hamburger,
    /// Distributions on [-1, 1].
    Hausdorff,
}

impl Bound {
    pub(super) const BOTH: [Bound; 2] = [Bound::Hamburger, Bound::Hausdorff];

    /// The exact bounds of moments; of distributions on an interval for the latter.
    pub(super) fn extremal(
        self,
        moments: &[RBig],
        [low, high]: [f64; 2],
        depth: f64,
    ) -> Result<Extremal, OracleError> {
        let depth = rational(depth)?;
        match self {
            Bound::Hamburger => hamburger(moments, &depth),
            Bound::Hausdorff => hausdorff(moments, [&rational(low)?, &rational(high)?], &depth),
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Bound::Hamburger => "Hamburger",
            Bound::Hausdorff => "Hausdorff",
        }
    }
}

/// Moments in f32 as they are.
pub(super) fn rationals(moments: &[f32]) -> Result<Vec<RBig>, OracleError> {
    moments
        .iter()
        .map(|&moment| rational(f64::from(moment)))
        .collect()
}

/// Exact bounds and their sensitivities, for a variance of `smallest_variance` at least.
pub(super) fn exact(
    bound: Bound,
    mut moments: Vec<RBig>,
    depth: f64,
    smallest_variance: f32,
) -> Result<([f64; 2], Option<[f64; 2]>), OracleError> {
    if smallest_variance > 0.0
        && let [mean, mean_square, ..] = &mut moments[..]
    {
        let least = &*mean * &*mean + rational(f64::from(smallest_variance))?;
        if *mean_square < least {
            *mean_square = least;
        }
    }
    let extremal = bound.extremal(&moments, [-1.0, 1.0], depth)?;
    let sensitivities = sensitivity(&moments, &rational(depth)?, &extremal);
    Ok(([extremal.lower, extremal.upper], sensitivities))
}

/// The unit of errors: 2^-24 (1 + sensitivity) for two and four moments. For six it is four times as much, and 16 times where the
/// bias leaves pivots that are so small that their roundings count.
pub(super) fn unit(count: usize, alpha: f64, sensitivity: f64) -> f64 {
    let factor = match count {
        0..=4 => 1.0,
        _ if alpha >= 5e-5 => 4.0,
        _ => 16.0,
    };
    factor * tolerance_unit(sensitivity)
}
