//! From which moment bias on moments are possible.

use serde::Serialize;

use crate::dense::{cholesky, inverse, smallest_eigenvalue};

/// What makes moments possible.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Condition {
    /// A distribution on the real line has them: their Hankel matrix is positive definite.
    Line,
    /// A distribution on the depth interval has them: that of the moments of (z - low)(high - z) dS is, too.
    Interval,
}

/// Alphas tried for a target that is itself on the boundary: 16 per decade from 1e-9 to almost 1.
const TRIED: i32 = 16 * 9;

/// How to find the smallest alpha towards one target of `M` moments, four or six.
pub(super) struct Repair<const M: usize> {
    interval: [f64; 2],
    condition: Condition,
    target: [f64; M],
    /// Inverse Cholesky factors of the target's matrices; none if it is on the boundary.
    outer: Option<Outer>,
    inner: Option<Inner>,
}

/// The matrices of six moments. Those of four are bordered with a one, which changes no other eigenvalue.
type Outer = [[f64; 4]; 4];
type Inner = [[f64; 3]; 3];

impl<const M: usize> Repair<M> {
    pub(super) fn new(interval: [f64; 2], condition: Condition, target: [f64; M]) -> Self {
        Self {
            interval,
            condition,
            target,
            outer: cholesky(outer(&target)).map(inverse),
            inner: cholesky(inner(&target, interval)).map(inverse),
        }
    }

    /// The alpha from which on `moments` are possible; infinite if none is.
    ///
    /// With the target's matrix as L L^T, that of the biased moments is positive semi-definite from
    /// alpha / (1 - alpha) = -(least eigenvalue of L^-1 H L^-T) on.
    pub(super) fn smallest_alpha(&self, moments: [f64; M]) -> f64 {
        let Some(l) = &self.outer else {
            return self.by_trial(moments);
        };
        let least = smallest_eigenvalue(congruent(l, &outer(&moments)));
        let least = match (self.condition, &self.inner) {
            (Condition::Line, _) => least,
            (Condition::Interval, None) => return self.by_trial(moments),
            (Condition::Interval, Some(l)) => least.min(smallest_eigenvalue(congruent(
                l,
                &inner(&moments, self.interval),
            ))),
        };
        if least >= 0.0 {
            0.0
        } else {
            least / (least - 1.0)
        }
    }

    fn by_trial(&self, moments: [f64; M]) -> f64 {
        (0..TRIED)
            .map(|index| 1e-9 * 10.0_f64.powf(f64::from(index) / 16.0))
            .find(|alpha| {
                let biased: [f64; M] =
                    core::array::from_fn(|j| moments[j] + alpha * (self.target[j] - moments[j]));
                cholesky(outer(&biased)).is_some()
                    && (self.condition == Condition::Line
                        || cholesky(inner(&biased, self.interval)).is_some())
            })
            .unwrap_or(f64::INFINITY)
    }
}

/// The Hankel matrix of the moments.
fn outer<const M: usize>(moments: &[f64; M]) -> Outer {
    hankel(M / 2 + 1, |power| moment(moments, power))
}

/// The Hankel matrix of the moments of (z - low)(high - z) dS.
fn inner<const M: usize>(moments: &[f64; M], [low, high]: [f64; 2]) -> Inner {
    let moment = |power: usize| moment(moments, power);
    hankel(M / 2, |power| {
        (low + high) * moment(power + 1) - low * high * moment(power) - moment(power + 2)
    })
}

fn moment<const M: usize>(moments: &[f64; M], power: usize) -> f64 {
    match power {
        0 => 1.0,
        _ => moments[power - 1],
    }
}

/// A Hankel matrix of `size` rows in the corner of an identity.
fn hankel<const N: usize>(size: usize, entry: impl Fn(usize) -> f64) -> [[f64; N]; N] {
    core::array::from_fn(|row| {
        core::array::from_fn(|column| {
            if row.max(column) < size {
                entry(row + column)
            } else {
                f64::from(u8::from(row == column))
            }
        })
    })
}

/// L M L^T.
fn congruent<const N: usize>(l: &[[f64; N]; N], matrix: &[[f64; N]; N]) -> [[f64; N]; N] {
    let mut half = [[0.0; N]; N];
    for row in 0..N {
        for column in 0..N {
            half[row][column] = (0..N).map(|k| l[row][k] * matrix[k][column]).sum();
        }
    }
    core::array::from_fn(|row| {
        core::array::from_fn(|column| (0..N).map(|k| half[row][k] * l[column][k]).sum())
    })
}
