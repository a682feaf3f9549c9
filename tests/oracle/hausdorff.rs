//! Exact bounds on an interval.

use std::path::Path;

use moment_shadows_lab::oracle::{
    Mixture, OracleError, hamburger, hausdorff, rational, sensitivity,
};
use moment_shadows_lab::vectors::{AGREEMENT, agreement, file};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::{exact_hausdorff, mixtures};

const SIGNED: [f64; 2] = [-1.0, 1.0];

/// Two oracles that share no code: ours and the one that made the published vectors.
#[test]
fn published_vectors_agree_for_every_number_of_moments_and_both_kinds() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/vectors/moment_problem.json");
    let agreement = agreement(&file::read(&path).unwrap());
    for (kind, agreement) in &agreement {
        println!(
            "{kind}: {} pairs of bounds, {:e}",
            agreement.evaluated, agreement.largest
        );
        // The file states 17 digits.
        assert!(
            agreement.largest <= AGREEMENT,
            "{kind}: {}",
            agreement.largest
        );
    }
    // Six vectors of two moments, 41 of four with 161 biased ones, 21 of six with 79 biased ones, two of which rounding has
    // moved out of the interval's moment space.
    let counts: Vec<usize> = agreement
        .values()
        .map(|agreement| agreement.evaluated)
        .collect();
    assert_eq!(counts, [6, 202, 100, 6, 202, 98]);
}

#[test]
fn extremal_distributions_are_distributions_with_the_given_moments() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut with_ends = 0;
    for class in mixtures::CLASSES {
        for count in [2, 4, 6] {
            for _ in 0..10 {
                let sample = mixtures::sample(class, &mut random);
                let extremal = exact_hausdorff(&sample.atoms, count, SIGNED, sample.fragment_depth);
                let points: Vec<(f64, f64)> = extremal
                    .points
                    .iter()
                    .map(|point| {
                        (
                            point.position.to_f64().value(),
                            point.weight.to_f64().value(),
                        )
                    })
                    .collect();
                with_ends += usize::from(extremal.points.iter().any(|point| point.at_end));
                assert!(
                    points
                        .iter()
                        .all(|&(z, weight)| z.abs() <= 1.0 && weight >= 0.0)
                );
                let moments = Mixture::new(&sample.atoms).unwrap().moments(count);
                for (power, moment) in moments.iter().enumerate() {
                    let ours: f64 = points
                        .iter()
                        .map(|&(z, w)| w * z.powi(power as i32 + 1))
                        .sum();
                    // Sums of up to five terms below one in f64.
                    assert!(
                        (ours - moment.to_f64().value()).abs() < 1e-14,
                        "{class}, {count}"
                    );
                }
                let mixture = Mixture::new(&sample.atoms).unwrap();
                let depth = rational(sample.fragment_depth).unwrap();
                assert!(extremal.lower <= mixture.below(&depth) + 1e-15);
                assert!(extremal.upper >= mixture.at_or_below(&depth) - 1e-15);
                assert!(0.0 <= extremal.lower && extremal.lower <= extremal.upper);
                assert!(extremal.upper <= 1.0 + 1e-15);
            }
        }
    }
    // Neither kind of support is rare.
    assert!((25..250).contains(&with_ends), "{with_ends}");
}

/// Scales and offsets that are powers of two lose nothing, so that the bounds may not change at all.
#[test]
fn an_interval_may_lie_anywhere() {
    let mut random = ChaCha8Rng::seed_from_u64(2);
    for class in [
        "3 to 6 surfaces",
        "fragment on a surface",
        "clamped ends",
        "slope",
    ] {
        for count in [2, 4, 6] {
            for _ in 0..5 {
                let mut sample = mixtures::sample(class, &mut random);
                for (depth, _) in &mut sample.atoms {
                    *depth = f64::from(*depth as f32);
                }
                let depth = f64::from(sample.fragment_depth as f32);
                let signed = exact_hausdorff(&sample.atoms, count, SIGNED, depth);
                for (scale, offset) in [(0.5, 0.5), (4.0, -32.0)] {
                    let map = |z: f64| scale * z + offset;
                    let atoms: Vec<(f64, f64)> = sample
                        .atoms
                        .iter()
                        .map(|&(z, weight)| (map(z), weight))
                        .collect();
                    let moved = exact_hausdorff(&atoms, count, SIGNED.map(map), map(depth));
                    assert_eq!([moved.lower, moved.upper], [signed.lower, signed.upper]);
                }
            }
        }
    }
}

#[test]
fn the_ends_of_the_interval_and_what_is_beyond() {
    let atoms = [(-1.0, 0.25), (0.0, 0.25), (0.5, 0.25), (0.75, 0.25)];
    let at = |depth| exact_hausdorff(&atoms, 4, SIGNED, depth);
    // In front of everything, and behind it.
    assert_eq!([at(-1.5).lower, at(-1.5).upper], [0.0, 0.0]);
    assert_eq!([at(1.5).lower, at(1.5).upper], [1.0, 1.0]);
    // At the near end nothing can be in front, at the far end everything is in front of or at it.
    assert_eq!(at(-1.0).lower, 0.0);
    assert!(at(-1.0).upper >= 0.25 && at(-1.0).upper < 1.0);
    assert_eq!(at(1.0).upper, 1.0);
    assert!(at(1.0).lower > 0.5 && at(1.0).lower < 1.0);
}

/// Surfaces at the ends and one between them are the only distribution on the interval with their moments, although not on
/// the real line.
#[test]
fn a_distribution_on_the_boundary_is_recovered() {
    let atoms = [(-1.0, 0.25), (0.25, 0.5), (1.0, 0.25)];
    for (depth, below, at_or_below) in [
        (-0.5, 0.25, 0.25),
        (0.25, 0.25, 0.75),
        (0.5, 0.75, 0.75),
        (1.0, 0.75, 1.0),
        (-1.0, 0.0, 0.25),
    ] {
        let extremal = exact_hausdorff(&atoms, 4, SIGNED, depth);
        assert!(extremal.unique);
        // Roots are rounded to 320 bits.
        assert!(
            (extremal.lower - below).abs() < 1e-15,
            "{depth}: {}",
            extremal.lower
        );
        assert!(
            (extremal.upper - at_or_below).abs() < 1e-15,
            "{depth}: {}",
            extremal.upper
        );
        let line = crate::exact_hamburger(&atoms, 4, 0.5);
        assert!(!line.unique && line.lower < 0.74);
    }
}

/// The condition number is a sum of derivatives, so small steps of the exact bound must show it.
#[test]
fn sensitivity_is_the_derivative_with_ends_or_without() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let step = rational(1e-12).unwrap();
    let mut with_ends = 0;
    for _ in 0..30 {
        let sample = mixtures::sample("3 to 6 surfaces", &mut random);
        let depth = random.random_range(-0.9..0.9);
        let extremal = exact_hausdorff(&sample.atoms, 4, SIGNED, depth);
        let moments = Mixture::new(&sample.atoms).unwrap().moments(4);
        let depth = rational(depth).unwrap();
        let Some(sensitivities) = sensitivity(&moments, &depth, &extremal) else {
            continue;
        };
        with_ends += usize::from(extremal.points.iter().any(|point| point.at_end));
        let [low, high] = SIGNED.map(|end| rational(end).unwrap());
        let mut sums = [0.0; 2];
        for index in 0..=4 {
            let mut moved = moments.clone();
            let mut fragment = depth.clone();
            let factor = if index < 4 {
                &mut moved[index]
            } else {
                &mut fragment
            };
            let change = &*factor * &step;
            *factor += &change;
            let other = hausdorff(&moved, [&low, &high], &fragment).unwrap();
            sums[0] += ((other.lower - extremal.lower) / 1e-12).abs();
            sums[1] += ((other.upper - extremal.upper) / 1e-12).abs();
        }
        for side in 0..2 {
            // Differences of f64 bounds over 1e-12 are exact to some 1e-4; the second derivative adds to that.
            let error = (sums[side] - sensitivities[side]).abs();
            assert!(
                error < 2e-3 * (1.0 + sensitivities[side]),
                "{sums:?} {sensitivities:?}"
            );
        }
    }
    assert!(with_ends >= 3, "{with_ends}");
}

#[test]
fn what_is_no_moment_problem_is_refused() {
    let zero = rational(0.0).unwrap();
    let [low, high] = SIGNED.map(|end| rational(end).unwrap());
    // A surface beyond the far end: possible on the real line, impossible on the interval.
    let beyond = Mixture::new(&[(0.0, 0.5), (0.25, 0.25), (1.5, 0.25)])
        .unwrap()
        .moments(4);
    assert!(hamburger(&beyond, &zero).is_ok());
    assert_eq!(
        hausdorff(&beyond, [&low, &high], &zero).unwrap_err(),
        OracleError::NotOnInterval
    );
    assert_eq!(
        hausdorff(&beyond, [&high, &low], &zero).unwrap_err(),
        OracleError::EmptyInterval(1.0, -1.0)
    );
    assert_eq!(
        hausdorff(&beyond[..3], [&low, &high], &zero).unwrap_err(),
        OracleError::MomentCount(3)
    );
}
