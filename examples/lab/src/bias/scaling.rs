//! The bound of the moment bias by the error of a channel.
//!
//! Moments on the boundary of the moment space have a polynomial that is nowhere negative and whose expectation is zero: a
//! square p^2 on the real line, and (z - low)(high - z) l^2 too on an interval. An error `e` of every channel changes this
//! expectation by up to e times the sum of the magnitudes of its derivatives, and a bias adds alpha times the
//! expectation under its target. So alpha >= K e suffices to first order, K being the largest ratio over all such
//! polynomials.

use super::definite::Condition;
use super::form::Form;

/// Places that the first search tries, at most, over all parameters.
const PLACES: f64 = 300_000.0;

/// Shrinkings of the step afterwards.
const REFINEMENTS: u32 = 40;

/// K: the alpha that a rounding needs, in units of the error of a channel.
#[must_use]
pub fn error_factor<const M: usize>(form: &Form<M>) -> f64 {
    let [low, high] = form.interval;
    let root = |at: f64| low + (high - low) * at.clamp(0.0, 1.0);
    let inside = |places: &[f64], first: Vec<f64>| {
        places
            .iter()
            .fold(first, |product, &at| multiply(&product, &[-root(at), 1.0]))
    };
    // All roots but one in the interval, the other anywhere on the projective line.
    let square = |places: &[f64]| {
        let [others @ .., angle] = places else {
            return f64::NEG_INFINITY;
        };
        let (sine, cosine) = (core::f64::consts::PI * angle).sin_cos();
        let p = inside(others, vec![-sine, cosine]);
        ratio(form, &multiply(&p, &p))
    };
    let on_line = largest(M / 2, square);
    match form.condition {
        Condition::Line => on_line,
        Condition::Interval => {
            let inner = |places: &[f64]| {
                let l = inside(places, vec![1.0]);
                let weight = [-low * high, low + high, -1.0];
                ratio(form, &multiply(&multiply(&l, &l), &weight))
            };
            on_line.max(largest(M / 2 - 1, inner))
        }
    }
}

/// The maximum over [0, 1]^`parameters`.
fn largest(parameters: usize, function: impl Fn(&[f64]) -> f64) -> f64 {
    let steps = PLACES.powf(1.0 / parameters as f64).min(256.0) as usize;
    let mut best = vec![0.0; parameters];
    let mut value = f64::NEG_INFINITY;
    for at in lattice(parameters, steps + 1) {
        let at: Vec<f64> = at.map(|step| step as f64 / steps as f64).collect();
        let here = function(&at);
        if here > value {
            (best, value) = (at, here);
        }
    }
    let mut step = 1.0 / steps as f64;
    for _ in 0..REFINEMENTS {
        for direction in lattice(parameters, 3) {
            let at: Vec<f64> = best
                .iter()
                .zip(direction)
                .map(|(place, direction)| place + step * (direction as f64 - 1.0))
                .collect();
            let here = function(&at);
            if here > value {
                (best, value) = (at, here);
            }
        }
        step *= 0.6;
    }
    value
}

/// The points of a lattice with `side` of them along each axis, as coordinates.
fn lattice(
    axes: usize,
    side: usize,
) -> impl Iterator<Item = impl Iterator<Item = usize> + use<>> + use<> {
    (0..side.pow(axes as u32))
        .map(move |index| (0..axes).map(move |axis| index / side.pow(axis as u32) % side))
}

/// What the errors of channels do to the expectation of a polynomial of degree `M`, over what the target does.
fn ratio<const M: usize>(form: &Form<M>, q: &[f64]) -> f64 {
    let of_moments: [f64; M] = core::array::from_fn(|index| q[index + 1]);
    let gradient = form
        .basis
        .as_ref()
        .map_or(of_moments, |basis| basis.gradient(&of_moments));
    let errors: f64 = gradient.iter().map(|entry| entry.abs()).sum();
    let repaired: f64 = q[0]
        + of_moments
            .iter()
            .zip(form.target)
            .map(|(q, b)| q * b)
            .sum::<f64>();
    if repaired > 1e-12 {
        errors / repaired
    } else {
        f64::INFINITY
    }
}

fn multiply(one: &[f64], other: &[f64]) -> Vec<f64> {
    let mut product = vec![0.0; one.len() + other.len() - 1];
    for (i, a) in one.iter().enumerate() {
        for (j, b) in other.iter().enumerate() {
            product[i + j] += a * b;
        }
    }
    product
}
