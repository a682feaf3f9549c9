//! Bounds from two moments, of depth or of a function of it, and those of four moments that have points at both ends.

use super::Surfaces;
use crate::truth::exact_bound;

/// Cantelli's inequality for a rising function of depth that is 0 at the fragment: the least share in front of it that mean
/// and variance of the function allow.
pub(super) fn cantelli(surfaces: &Surfaces<'_>, function: impl Fn(f64) -> f64) -> f64 {
    let mean = surfaces.mean(&function);
    if mean >= 0.0 {
        return 0.0;
    }
    let variance = surfaces.mean(|z| (function(z) - mean).powi(2));
    if variance.is_finite() && mean.is_finite() {
        // Neither square may overflow.
        1.0 / (1.0 + variance / mean / mean)
    } else {
        0.0
    }
}

/// The least share in front of the fragment for distributions on [-1, 1] with the four moments of the surfaces.
///
/// The extremal distribution either is that on the real line, or consists of both ends, the fragment and one more point.
pub(super) fn hausdorff(surfaces: &Surfaces<'_>, fragment_depth: f64) -> f64 {
    let on_line = || exact_bound::lower_bound(surfaces.depths, surfaces.weights, fragment_depth);
    if fragment_depth <= -1.0 {
        return 0.0;
    }
    if fragment_depth > 1.0 {
        return 1.0;
    }
    if fragment_depth == 1.0 {
        return on_line();
    }
    with_ends(surfaces, fragment_depth).unwrap_or_else(on_line)
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
