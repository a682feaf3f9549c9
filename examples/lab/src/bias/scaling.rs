//! The bound of the moment bias by the error of a channel.
//!
//! Moments on the boundary of the moment space have a polynomial that is nowhere negative and whose expectation is zero: a
//! square p^2 on the real line, and (z - low)(high - z) l^2 too on an interval. An error `e` of every channel changes this
//! expectation by up to e times the sum of the magnitudes of its derivatives, and a bias adds alpha times the
//! expectation under its target. So alpha >= K e suffices to first order, K being the largest ratio over all such
//! polynomials.

use super::definite::Condition;
use super::form::Form;

/// Steps of the first search along each parameter.
const STEPS: u32 = 256;

/// Halvings of the step afterwards.
const REFINEMENTS: u32 = 40;

/// K: the alpha that a rounding needs, in units of the error of a channel.
#[must_use]
pub fn error_factor(form: &Form) -> f64 {
    let [low, high] = form.interval;
    // One root in the interval, the other anywhere on the projective line.
    let square = |[root, angle]: [f64; 2]| {
        let root = low + (high - low) * root.clamp(0.0, 1.0);
        let (sine, cosine) = (core::f64::consts::PI * angle).sin_cos();
        let p = [root * sine, -(root * cosine + sine), cosine];
        ratio(form, multiply(&p, &p))
    };
    let on_line = largest(square);
    match form.condition {
        Condition::Line => on_line,
        Condition::Interval => {
            let inner = |[_, root]: [f64; 2]| {
                let root = low + (high - low) * root.clamp(0.0, 1.0);
                let l = [-root, 1.0];
                let weight = [-low * high, low + high, -1.0];
                ratio(form, multiply(&multiply(&l, &l), &weight))
            };
            on_line.max(largest(inner))
        }
    }
}

/// The maximum over [0, 1]^2.
fn largest(function: impl Fn([f64; 2]) -> f64) -> f64 {
    let place = |step: u32| f64::from(step) / f64::from(STEPS);
    let mut best = [0.0; 2];
    let mut value = f64::NEG_INFINITY;
    for first in 0..=STEPS {
        for second in 0..=STEPS {
            let at = [place(first), place(second)];
            let here = function(at);
            if here > value {
                (best, value) = (at, here);
            }
        }
    }
    let mut step = place(1);
    for _ in 0..REFINEMENTS {
        for direction in [
            [1.0, 0.0],
            [-1.0, 0.0],
            [0.0, 1.0],
            [0.0, -1.0],
            [1.0, 1.0],
            [-1.0, -1.0],
            [1.0, -1.0],
            [-1.0, 1.0],
        ] {
            let at = core::array::from_fn(|axis| best[axis] + step * direction[axis]);
            let here = function(at);
            if here > value {
                (best, value) = (at, here);
            }
        }
        step *= 0.6;
    }
    value
}

/// What the errors of channels do to the expectation of a polynomial of degree 4, over what the target does.
fn ratio(form: &Form, q: Vec<f64>) -> f64 {
    let of_moments = [q[1], q[2], q[3], q[4]];
    let gradient = form
        .basis
        .as_ref()
        .map_or(of_moments, |basis| basis.gradient(of_moments));
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
