//! How strongly the sharp bounds react to rounding of their arguments, for tolerances that are derived and not tuned.

use core::cmp::Ordering;

use dashu::rational::RBig;

use super::exact::Extremal;
use super::polynomial::{Real, evaluate_real, real};

/// The componentwise condition numbers sum_j |b_j dG/db_j| + |depth dG/d(depth)| of the bounds G = lower and upper.
///
/// By duality the lower bound is the expectation of the largest polynomial that stays below the step at the fragment. That
/// polynomial interpolates the step at the support and touches it there, and its coefficients are the derivatives with
/// respect to the moments. `extremal` must be what the oracle gave for the same arguments. Nothing is returned for moments
/// of a single distribution: the bounds jump there.
#[must_use]
pub fn sensitivity(moments: &[RBig], depth: &RBig, extremal: &Extremal) -> Option<[f64; 2]> {
    if extremal.unique {
        return None;
    }
    let depth = real(depth);
    let moments: Vec<Real> = moments.iter().map(real).collect();
    let of = |counts: fn(Ordering) -> bool| {
        let dual = dual_polynomial(extremal, counts);
        let by_moments = dual
            .iter()
            .skip(1)
            .zip(&moments)
            .fold(real(&RBig::ZERO), |sum, (derivative, moment)| {
                sum + absolute(derivative * moment)
            });
        let slope: Vec<Real> = dual
            .iter()
            .enumerate()
            .skip(1)
            .map(|(power, coefficient)| coefficient * real(&RBig::from(power)))
            .collect();
        // Moving the fragment moves the constraint at it, whose multiplier is the fragment's weight.
        let weight = extremal
            .points
            .iter()
            .filter(|point| point.side == Ordering::Equal)
            .fold(real(&RBig::ZERO), |sum, point| sum + &point.weight);
        let by_depth = absolute(evaluate_real(&slope, &depth) * weight * &depth);
        (by_moments + by_depth).to_f64().value()
    };
    Some([of(Ordering::is_lt), of(Ordering::is_le)])
}

/// The unit in which errors of an f32 solver are counted: 2^-24 (1 + sensitivity).
#[must_use]
pub fn tolerance_unit(sensitivity: f64) -> f64 {
    (1.0 + sensitivity) / f64::from(1 << 24)
}

/// The polynomial of lowest degree that is 1 at the support points that count and 0 at the others, with a horizontal
/// tangent at all but the fragment and the ends of an interval. Coefficients, constant first.
fn dual_polynomial(extremal: &Extremal, counts: fn(Ordering) -> bool) -> Vec<Real> {
    let zero = real(&RBig::ZERO);
    let mut nodes = Vec::new();
    let mut differences = Vec::new();
    for point in &extremal.points {
        let value = if counts(point.side) {
            real(&RBig::ONE)
        } else {
            zero.clone()
        };
        // At an end the polynomial need not stay below the step on both sides.
        let once = point.side == Ordering::Equal || point.at_end;
        let times = if once { 1 } else { 2 };
        for _ in 0..times {
            nodes.push(point.position.clone());
            differences.push(value.clone());
        }
    }
    // Newton's divided differences; that of a doubled node is its derivative, zero.
    for order in 1..nodes.len() {
        for index in (order..nodes.len()).rev() {
            let span = &nodes[index] - &nodes[index - order];
            differences[index] = if span == zero {
                zero.clone()
            } else {
                (&differences[index] - &differences[index - 1]) / span
            };
        }
    }
    let mut polynomial: Vec<Real> = Vec::new();
    for (node, difference) in nodes.iter().zip(&differences).rev() {
        // polynomial * (z - node) + difference
        let mut next = vec![zero.clone(); polynomial.len() + 1];
        for (power, coefficient) in polynomial.iter().enumerate() {
            next[power] = &next[power] - coefficient * node;
            next[power + 1] = &next[power + 1] + coefficient;
        }
        next[0] = &next[0] + difference;
        polynomial = next;
    }
    polynomial
}

fn absolute(value: Real) -> Real {
    if value < real(&RBig::ZERO) {
        -value
    } else {
        value
    }
}
