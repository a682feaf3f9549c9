//! Polynomials with exact coefficients and their real roots with 320 bits.

use dashu::float::{FBig, round::mode::HalfEven};
use dashu::rational::RBig;

/// A floating-point number with 320 bits of mantissa.
pub type Real = FBig<HalfEven, 2>;

/// Bits of every [`Real`]. Moments biased by 1e-7 lose about 60 bits on the way to a weight, so far fewer would do.
const PRECISION: usize = 320;

/// Halvings of an interval until its ends are neighbours: more than the precision, for roots close to zero.
const BISECTIONS: usize = 1000;

/// The nearest [`Real`].
pub(super) fn real(value: &RBig) -> Real {
    value.to_float::<HalfEven, 2>(PRECISION).value()
}

/// The value at `x` of a polynomial given by its coefficients, constant first.
pub(super) fn evaluate(coefficients: &[RBig], x: &RBig) -> RBig {
    coefficients
        .iter()
        .rev()
        .fold(RBig::ZERO, |sum, coefficient| sum * x + coefficient)
}

/// The value that [`evaluate`] gives, rounded.
pub(super) fn evaluate_real(coefficients: &[Real], x: &Real) -> Real {
    coefficients
        .iter()
        .rev()
        .fold(real(&RBig::ZERO), |sum, coefficient| sum * x + coefficient)
}

/// The polynomial divided by (x - root), for an exact root.
pub(super) fn deflate(coefficients: &[RBig], root: &RBig) -> Vec<RBig> {
    let mut carry = RBig::ZERO;
    let mut quotient: Vec<RBig> = coefficients
        .iter()
        .skip(1)
        .rev()
        .map(|coefficient| {
            carry = &carry * root + coefficient;
            carry.clone()
        })
        .collect();
    quotient.reverse();
    quotient
}

/// The roots, ascending, of a polynomial whose roots are all real and simple and whose last coefficient is not zero.
pub(super) fn roots(coefficients: &[RBig]) -> Vec<Real> {
    match coefficients {
        [] | [_] => Vec::new(),
        [c0, c1] => vec![real(&(-c0 / c1))],
        [c0, c1, c2] => {
            let half: RBig = c1 / (c2 * RBig::from(2));
            let product = c0 / c2;
            // Positive for simple real roots.
            let discriminant = real(&(&half * &half - &product));
            let root = discriminant.sqrt();
            let half = real(&half);
            // The root of larger magnitude without cancellation, the other from their product.
            let far = if half > real(&RBig::ZERO) {
                -half - root
            } else {
                root - half
            };
            let near = if far == real(&RBig::ZERO) {
                far.clone()
            } else {
                real(&product) / &far
            };
            if near < far {
                vec![near, far]
            } else {
                vec![far, near]
            }
        }
        [.., leading] => {
            // One root lies between each two neighbours among the derivative's roots and Cauchy's bound.
            let derivative: Vec<RBig> = coefficients
                .iter()
                .enumerate()
                .skip(1)
                .map(|(power, coefficient)| coefficient * RBig::from(power))
                .collect();
            let bound = coefficients.iter().fold(RBig::ONE, |bound, coefficient| {
                let ratio = coefficient / leading;
                bound + if ratio < RBig::ZERO { -ratio } else { ratio }
            });
            let bound = real(&bound);
            let mut ends = vec![-bound.clone()];
            ends.extend(roots(&derivative));
            ends.push(bound);
            let coefficients: Vec<Real> = coefficients.iter().map(real).collect();
            ends.windows(2)
                .map(|ends| bisect(&coefficients, ends[0].clone(), ends[1].clone()))
                .collect()
        }
    }
}

/// The root between two points at which the polynomial has opposite signs.
fn bisect(coefficients: &[Real], mut low: Real, mut high: Real) -> Real {
    let zero = real(&RBig::ZERO);
    let two = real(&RBig::from(2));
    let rises = evaluate_real(coefficients, &low) < zero;
    for _ in 0..BISECTIONS {
        let middle = (&low + &high) / &two;
        if middle <= low || middle >= high {
            break;
        }
        if (evaluate_real(coefficients, &middle) < zero) == rises {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}
