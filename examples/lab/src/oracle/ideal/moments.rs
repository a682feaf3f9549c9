//! The bounds that power moments allow, from the surfaces themselves: on the real line for any number of moments, and of four on
//! [-1, 1].

use super::Surfaces;

/// Halvings of an interval, enough for any f64 to settle.
const HALVINGS: usize = 120;

/// A polynomial at the surfaces this close to zero, relative to the terms that it is made of, is rounding: they are its roots.
const SINGULAR: f64 = 16.0 * f64::EPSILON;

/// A point this far away weighs nothing, and its powers can be computed.
const INFINITELY_FAR: f64 = 1e30;

/// No two depths are farther apart.
const REACH: f64 = 4.0;

/// The least share in front of the fragment that the first `2 * degree` moments of the surfaces allow.
///
/// The orthogonal polynomials of the surfaces come from Stieltjes' procedure on distances from the fragment. The extremal
/// distribution's points are where the kernel K(t, 0) of all polynomials up to `degree` vanishes, one between each two
/// neighbouring roots of the last polynomial and one beyond each end; the weight of a point t is 1/K(t, t).
pub(super) fn on_the_line(surfaces: &Surfaces<'_>, fragment_depth: f64, degree: usize) -> f64 {
    let Some(recurrence) = Recurrence::new(surfaces, fragment_depth, degree) else {
        return surfaces.mean(|z| f64::from(z < fragment_depth));
    };
    let below = recurrence.nodes.iter().filter(|node| **node < 0.0).count();
    let at_fragment = recurrence.weight(0.0);
    let share = if below == degree {
        1.0 - at_fragment
    } else {
        let ends: Vec<f64> = core::iter::once(-INFINITELY_FAR)
            .chain(recurrence.nodes.iter().copied())
            .collect();
        (0..below)
            .map(|index| {
                recurrence.weight(recurrence.root(ends[index], ends[index + 1], index == 0))
            })
            .sum()
    };
    share.clamp(0.0, 1.0)
}

/// Monic orthogonal polynomials of distances from the fragment.
struct Recurrence {
    /// p_(j+1) = (t - shifts[j]) p_j - norms[j] / norms[j-1] p_(j-1).
    shifts: Vec<f64>,
    /// E[p_j^2], one more than the shifts.
    norms: Vec<f64>,
    /// The roots of the last polynomial, ascending.
    nodes: Vec<f64>,
}

impl Recurrence {
    /// Nothing if the surfaces are no more than `degree`.
    fn new(surfaces: &Surfaces<'_>, fragment_depth: f64, degree: usize) -> Option<Self> {
        let mut recurrence = Self {
            shifts: Vec::new(),
            norms: vec![1.0],
            nodes: Vec::new(),
        };
        for index in 0..degree {
            let norm = recurrence.norms[index];
            let shift = surfaces.mean(|z| {
                let t = z - fragment_depth;
                t * recurrence.polynomial(index, t).powi(2)
            }) / norm;
            recurrence.shifts.push(shift);
            let value = |z: f64| recurrence.polynomial(index + 1, z - fragment_depth);
            let magnitude = |z: f64| recurrence.magnitude(index + 1, z - fragment_depth);
            let next = surfaces.mean(|z| value(z).powi(2));
            if next <= surfaces.mean(|z| (SINGULAR * magnitude(z)).powi(2)) {
                return None;
            }
            recurrence.norms.push(next);
            // The new roots interlace with the previous ones.
            let ends: Vec<f64> = core::iter::once(-REACH)
                .chain(recurrence.nodes.iter().copied())
                .chain([REACH])
                .collect();
            recurrence.nodes = ends
                .windows(2)
                .map(|ends| bisect(ends[0], ends[1], |t| recurrence.polynomial(index + 1, t)))
                .collect();
        }
        Some(recurrence)
    }

    fn polynomial(&self, degree: usize, t: f64) -> f64 {
        let (mut before, mut value) = (0.0, 1.0);
        for index in 0..degree {
            let ratio = if index == 0 {
                0.0
            } else {
                self.norms[index] / self.norms[index - 1]
            };
            (before, value) = (value, (t - self.shifts[index]) * value - ratio * before);
        }
        value
    }

    /// The sum of the magnitudes of all that `polynomial` adds and subtracts.
    fn magnitude(&self, degree: usize, t: f64) -> f64 {
        let (mut before, mut value) = (0.0, 1.0);
        for index in 0..degree {
            let ratio = if index == 0 {
                0.0
            } else {
                self.norms[index] / self.norms[index - 1]
            };
            let factor = t.abs() + self.shifts[index].abs();
            (before, value) = (value, factor * value + ratio * before);
        }
        value
    }

    fn kernel(&self, one: f64, other: f64) -> f64 {
        self.norms
            .iter()
            .enumerate()
            .map(|(degree, norm)| {
                self.polynomial(degree, one) * self.polynomial(degree, other) / norm
            })
            .sum()
    }

    fn weight(&self, t: f64) -> f64 {
        1.0 / self.kernel(t, t)
    }

    /// The point in an interval; the outermost ones are found by their reciprocal distance.
    fn root(&self, low: f64, high: f64, outermost: bool) -> f64 {
        if outermost {
            1.0 / bisect(1.0 / high, 1.0 / low, |y| self.kernel(1.0 / y, 0.0))
        } else {
            bisect(low, high, |t| self.kernel(t, 0.0))
        }
    }
}

/// Where a function changes its sign.
fn bisect(mut low: f64, mut high: f64, function: impl Fn(f64) -> f64) -> f64 {
    let sign = function(high) > 0.0;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if (function(middle) > 0.0) == sign {
            high = middle;
        } else {
            low = middle;
        }
    }
    0.5 * (low + high)
}

/// The least share in front of the fragment for distributions on [-1, 1] with the four moments of the surfaces.
///
/// The extremal distribution either is that on the real line, or consists of both ends, the fragment and one more point.
pub(super) fn on_the_interval(surfaces: &Surfaces<'_>, fragment_depth: f64) -> f64 {
    if fragment_depth <= -1.0 {
        return 0.0;
    }
    if fragment_depth > 1.0 {
        return 1.0;
    }
    let with_ends = (fragment_depth < 1.0).then(|| with_ends(surfaces, fragment_depth));
    with_ends
        .flatten()
        .unwrap_or_else(|| on_the_line(surfaces, fragment_depth, 2))
}

/// The share in front of the fragment of the distribution with points at both ends, if it is one.
fn with_ends(surfaces: &Surfaces<'_>, fragment_depth: f64) -> Option<f64> {
    // The distribution (1 - z^2) dS has the fragment and one more point, and three moments known.
    let inner = |z: f64| (1.0 - z) * (1.0 + z);
    let mass = surfaces.mean(inner);
    if mass <= 0.0 {
        // All surfaces are at the ends.
        return Some(surfaces.mean(|z| f64::from(z < fragment_depth)));
    }
    let mean = surfaces.mean(|z| inner(z) * (z - fragment_depth)) / mass;
    let variance = surfaces.mean(|z| inner(z) * ((z - fragment_depth) - mean).powi(2)) / mass;
    // The distance of the other point from the fragment; its share of the mass is mean / other.
    let other = mean + variance / mean;
    let position = fragment_depth + other;
    if !(position > -1.0 && position < 1.0) {
        return None;
    }
    let at_other = mass * (mean / other) / inner(position);
    // The weight of a point is the mean of the cubic that is 1 there and 0 at the other three points.
    let end = |side: f64| {
        let cubic = |z: f64| {
            let t = z - fragment_depth;
            (1.0 + side * z) * t * (t - other)
        };
        let scale = 2.0 * (1.0 - side * fragment_depth) * (1.0 - side * position);
        surfaces.mean(cubic) / scale
    };
    let (near, far) = (end(-1.0), end(1.0));
    if near < 0.0 || far < 0.0 {
        return None;
    }
    Some(if other < 0.0 {
        (near + at_other).min(1.0)
    } else {
        near
    })
}
