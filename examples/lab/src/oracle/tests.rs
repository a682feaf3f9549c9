#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use std::path::Path;
use std::str::FromStr;

use dashu::rational::RBig;

use super::polynomial::{evaluate_real, real, roots};
use super::{Mixture, OracleError, hamburger, rational, sensitivity};
use crate::vectors::file::{Vector, read};

fn vectors() -> Vec<Vector> {
    let file =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/vectors/moment_problem.json");
    read(&file).unwrap()
}

fn exact(values: &[f64]) -> Vec<RBig> {
    values
        .iter()
        .map(|&value| rational(value).unwrap())
        .collect()
}

/// Two oracles that share no code: ours and the one that made the published vectors (2, 4 and 6 moments). They print 17
/// digits, so 1e-15 is all that may remain.
#[test]
fn agrees_with_the_published_bounds_of_exact_moments() {
    for vector in vectors() {
        let moments: Vec<RBig> = vector
            .moments
            .iter()
            .map(|text| RBig::from_str(text).unwrap())
            .collect();
        let ours = hamburger(&moments, &rational(vector.depth).unwrap()).unwrap();
        let [lower, upper] = vector.hamburger.unwrap().both().unwrap();
        assert!(
            (ours.lower - lower).abs() < 1e-15,
            "{}: {} is not {lower}",
            vector.id,
            ours.lower
        );
        assert!(
            (ours.upper - upper).abs() < 1e-15,
            "{}: {} is not {upper}",
            vector.id,
            ours.upper
        );
    }
}

#[test]
fn agrees_with_the_published_bounds_of_biased_moments_and_their_sensitivity() {
    let mut records = 0;
    for vector in vectors() {
        for record in &vector.biased {
            let input: Vec<f64> = record.input().unwrap().into_iter().map(f64::from).collect();
            let (moments, depth) = (exact(&input), rational(record.depth).unwrap());
            let ours = hamburger(&moments, &depth).unwrap();
            let theirs = record.hamburger.unwrap().both().unwrap();
            let sensitivity = sensitivity(&moments, &depth, &ours).unwrap();
            for side in 0..2 {
                let bound = [ours.lower, ours.upper][side];
                assert!(
                    (bound - theirs[side]).abs() < 1e-15,
                    "{}: {bound} is not {}",
                    vector.id,
                    theirs[side]
                );
                // The file rounds to four digits.
                let given = record.sens.unwrap()[side].unwrap();
                let error = (sensitivity[side] - given).abs();
                assert!(
                    error <= 1e-3 * given + 1e-12,
                    "{} side {side}: sensitivity {} is not {given}",
                    vector.id,
                    sensitivity[side]
                );
            }
            records += 1;
        }
    }
    assert_eq!(records, 240);
}

#[test]
fn moments_of_one_distribution_give_that_distribution() {
    let mixture = Mixture::new(&[(-0.5, 1.0), (0.25, 3.0)]).unwrap();
    let moments = mixture.moments(4);
    for (depth, lower, upper) in [
        (-0.75, 0.0, 0.0),
        (-0.5, 0.0, 0.25),
        (0.0, 0.25, 0.25),
        (0.25, 0.25, 1.0),
        (0.5, 1.0, 1.0),
    ] {
        let depth = rational(depth).unwrap();
        let extremal = hamburger(&moments, &depth).unwrap();
        assert!(extremal.unique);
        assert!((extremal.lower - lower).abs() < 1e-16 && (extremal.upper - upper).abs() < 1e-16);
        assert_eq!(
            [mixture.below(&depth), mixture.at_or_below(&depth)],
            [lower, upper]
        );
        assert_eq!(sensitivity(&moments, &depth, &extremal), None);
    }
}

#[test]
fn a_fragment_on_a_gauss_node_leaves_one_point_at_infinity() {
    // Moments of the even distribution with b2 = 1/2, b4 = 1/2: its Gauss nodes are +-sqrt(b2), irrational; with b2 = 1/4 they
    // are +-1/2 exactly.
    let moments = exact(&[0.0, 0.25, 0.0, 0.125]);
    let extremal = hamburger(&moments, &rational(0.5).unwrap()).unwrap();
    assert_eq!(extremal.points.len(), 2);
    assert_eq!([extremal.lower, extremal.upper], [0.5, 1.0]);
    // The bound is continuous there.
    let near = hamburger(&moments, &rational(0.5 + 1e-9).unwrap()).unwrap();
    assert_eq!(near.points.len(), 3);
    assert!((near.lower - 0.5).abs() < 1e-8);
}

#[test]
fn impossible_moments_are_refused() {
    for moments in [
        [0.0, -1.0, 0.0, 1.0],
        [0.5, 0.1, 0.0, 1.0],
        [0.0, 0.5, 0.0, 0.1],
        [0.0, 0.0, 0.0, 1.0],
        [0.0, 0.0, 0.5, 1.0],
    ] {
        assert_eq!(
            hamburger(&exact(&moments), &RBig::ZERO).unwrap_err(),
            OracleError::NotMoments
        );
    }
    assert_eq!(
        hamburger(&exact(&[0.0, 0.5, 0.0]), &RBig::ZERO).unwrap_err(),
        OracleError::MomentCount(3)
    );
    assert!(matches!(rational(f64::NAN), Err(OracleError::NotFinite(_))));
    assert!(matches!(
        Mixture::new(&[(0.0, 0.0)]),
        Err(OracleError::NoSurface)
    ));
}

#[test]
fn roots_of_any_degree_are_roots() {
    // (z + 2)(z - 1/3)(z - 5)(z - 7), expanded by deflating nothing: coefficients by hand from its factors.
    let mut coefficients = vec![RBig::ONE];
    let expected = [-2.0, 0.25, 5.0, 7.0];
    for root in exact(&expected) {
        let mut next = vec![RBig::ZERO; coefficients.len() + 1];
        for (power, coefficient) in coefficients.iter().enumerate() {
            next[power] -= coefficient * &root;
            next[power + 1] += coefficient;
        }
        coefficients = next;
    }
    let found = roots(&coefficients);
    let rounded: Vec<f64> = found.iter().map(|root| root.to_f64().value()).collect();
    assert_eq!(rounded, expected);
    let coefficients: Vec<_> = coefficients.iter().map(real).collect();
    let residual = evaluate_real(&coefficients, &found[1]).to_f64().value();
    assert!(residual.abs() < 1e-80);
}

#[test]
fn a_moment_bias_is_a_mixture_with_three_planes() {
    let mixture = Mixture::new(&[(-0.25, 0.5), (0.75, 0.5)]).unwrap();
    let (alpha, beta) = (0.0625, 0.375);
    let biased = mixture.biased(alpha, beta).unwrap().four_moments();
    for (index, (biased, plain)) in biased.into_iter().zip(mixture.four_moments()).enumerate() {
        let target = if index % 2 == 1 { beta } else { 0.0 };
        assert_eq!(biased, plain + alpha * (target - plain));
    }
}
