//! The lower bound that four moments allow, without the errors of storage, bias and single precision.
//!
//! What a moment map gives differs from the truth for two reasons: four moments do not tell more, and they were stored
//! with errors that a moment bias had to repair. This bound has the first reason only, so the two can be told apart.
//!
//! The shader factors a Hankel matrix of moments. Here the orthogonal polynomials of the filtered depths are built from
//! the depths themselves (Stieltjes' procedure), relative to the fragment depth, so that nothing cancels, and the
//! support of the extremal distribution is found in the reciprocal distance to the fragment, which stays finite where
//! a point of it moves to infinity. The bound is that of Peters and Klein, "Moment Shadow Mapping", i3D 2015,
//! section 3: the least share of a distribution in front of the fragment that its first four moments allow.

use moment_shadows::FourMomentsBias;

use super::kernel::TapPattern;
use super::lookup::{Lookup, at_each};
use super::surface::MomentDepths;

/// The exact lower bound of the shadow intensity for each lookup in `depths` filtered with `taps`; 0 where there is no
/// lookup.
pub fn exact_bound(
    depths: &MomentDepths,
    taps: &TapPattern,
    lookups: &[Option<Lookup>],
) -> Vec<f32> {
    at_each(depths, taps, lookups, lower_bound)
}

/// The exact lower bound for each lookup after a moment bias, which storage with rounding errors cannot do without: what
/// is between this and [`exact_bound`] the bias costs, what is between this and a shader is the rounding of its storage.
pub fn biased_bound(
    depths: &MomentDepths,
    taps: &TapPattern,
    lookups: &[Option<Lookup>],
    bias: FourMomentsBias,
) -> Vec<f32> {
    let [alpha, second, fourth] = [bias.alpha, bias.second, bias.fourth].map(f64::from);
    at_each(depths, taps, lookups, |samples, weights, fragment_depth| {
        let moments = [1, 2, 3, 4].map(|power| {
            let target = [0.0, second, 0.0, fourth][power as usize - 1];
            let moment = weighted_sum(samples, weights, |z| z.powi(power));
            moment + alpha * (target - moment)
        });
        lower_bound_of_moments(moments, fragment_depth)
    })
}

/// The least share of depths in front of `fragment_depth` that the first four moments of the distribution with atoms at
/// `depths` allow. `weights` are not negative and sum to 1; both lists are equally long.
pub fn lower_bound(depths: &[f64], weights: &[f64], fragment_depth: f64) -> f64 {
    // Nothing lies in front of the fragment: the truth and with it any lower bound is 0.
    if depths.iter().all(|&depth| depth >= fragment_depth) {
        return 0.0;
    }
    // All distances are taken from the fragment.
    let mean = weighted_sum(depths, weights, |z| z - fragment_depth);
    let distance = |z: f64| (z - fragment_depth) - mean;
    let variance = weighted_sum(depths, weights, |z| distance(z).powi(2));
    if variance == 0.0 {
        return Recurrence::one_atom(mean).lower_bound();
    }
    let skew = weighted_sum(depths, weights, |z| distance(z).powi(3)) / variance;
    let residual = weighted_sum(depths, weights, |z| {
        let d = distance(z);
        (d * (d - skew) - variance).powi(2)
    });
    Recurrence {
        mean,
        variance,
        skew,
        residual,
    }
    .lower_bound()
}

/// The mean of `value` over atoms. Four partial sums, which do not wait for each other.
fn weighted_sum(depths: &[f64], weights: &[f64], value: impl Fn(f64) -> f64) -> f64 {
    let mut sums = [0.0; 4];
    let (depths, last_depths) = depths.as_chunks::<4>();
    let (weights, last_weights) = weights.as_chunks::<4>();
    for (depths, weights) in depths.iter().zip(weights) {
        for lane in 0..4 {
            sums[lane] += weights[lane] * value(depths[lane]);
        }
    }
    let last: f64 = last_depths
        .iter()
        .zip(last_weights)
        .map(|(&depth, weight)| weight * value(depth))
        .sum();
    (sums[0] + sums[1]) + (sums[2] + sums[3]) + last
}

/// The exact lower bound for given moments `[E z, E z^2, E z^3, E z^4]` of a distribution. They cancel where variances are
/// small, which f64 bears down to variances of about 1e-12; moments that belong to no distribution count as the nearest
/// singular one.
pub fn lower_bound_of_moments(moments: [f64; 4], fragment_depth: f64) -> f64 {
    let [b1, b2, b3, b4] = moments;
    let mean = b1 - fragment_depth;
    let variance = b2 - b1 * b1;
    if variance <= 0.0 {
        return Recurrence::one_atom(mean).lower_bound();
    }
    let covariance = b3 - b1 * b2;
    let residual = b4 - b2 * b2 - covariance * covariance / variance;
    Recurrence {
        mean,
        variance,
        skew: covariance / variance - 2.0 * b1,
        residual: residual.max(0.0),
    }
    .lower_bound()
}

/// The orthogonal polynomials of a distribution of distances t from the fragment: p1(t) = t - mean with squared norm
/// `variance`, p2(t) = p1 (p1 - skew) - variance with squared norm `residual`.
struct Recurrence {
    mean: f64,
    variance: f64,
    /// Third central moment over variance.
    skew: f64,
    residual: f64,
}

impl Recurrence {
    /// All depths are equal.
    fn one_atom(mean: f64) -> Self {
        Self {
            mean,
            variance: 0.0,
            skew: 0.0,
            residual: 0.0,
        }
    }

    /// The weight that the extremal distribution through the fragment puts in front of it.
    fn lower_bound(&self) -> f64 {
        let Self {
            mean,
            variance,
            skew,
            residual,
        } = *self;
        if variance == 0.0 {
            return if mean < 0.0 { 1.0 } else { 0.0 };
        }
        // At the fragment, t = 0: p1 is -mean. The roots of p2 are the Gauss nodes.
        let p2 = mean * (mean + skew) - variance;
        // On a Gauss node the bound is continuous, unless the distribution is nothing but its nodes; then rounding
        // may not decide whether the fragment is before or behind itself.
        let on_node = p2.abs() <= 1e-14 * (mean * mean + variance);
        if on_node || p2 > 0.0 {
            // Outside of the nodes all other points of the support lie on one side.
            if mean >= 0.0 {
                return 0.0;
            }
            let tail = if on_node { 0.0 } else { p2 * p2 / residual };
            return (1.0 - 1.0 / (1.0 + mean * mean / variance + tail)).clamp(0.0, 1.0);
        }
        // Between them the other two points r are the roots of the kernel polynomial k0 + k1 t + k2 t^2, here
        // multiplied with `residual`; with y = 1/r its leading coefficient k0 is positive, and k2 = p2 < 0: one root
        // of each sign.
        let k0 = residual * (1.0 + mean * mean / variance) + p2 * p2;
        let k1 = -residual * mean / variance - p2 * (2.0 * mean + skew);
        let half = -0.5 * (k1 + (k1 * k1 - 4.0 * k0 * p2).sqrt().copysign(k1));
        let (y, other) = (half / k0, p2 / half);
        let (front, behind) = (y.min(other), y.max(other));
        // The weight at 1/front: the mean of t (1 - t behind), which vanishes at the other two points.
        let second = variance + mean * mean;
        (front * front * (mean - second * behind) / (front - behind)).clamp(0.0, 1.0)
    }
}
