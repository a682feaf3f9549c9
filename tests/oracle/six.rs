//! Six moments without errors of storage: never looser than four of the same distribution.

use moment_shadows_lab::oracle::{Mixture, rational};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::{exact_hamburger, mixtures};

#[test]
fn exact_bounds_of_six_moments_lie_within_those_of_four() {
    let mut random = ChaCha8Rng::seed_from_u64(61);
    let mut tighter = 0;
    for class in mixtures::CLASSES {
        for _ in 0..60 {
            let sample = mixtures::sample(class, &mut random);
            let [four, six] =
                [4, 6].map(|count| exact_hamburger(&sample.atoms, count, sample.fragment_depth));
            // Exact bounds, rounded once.
            assert!(four.lower <= six.lower + 1e-15, "{class}");
            assert!(four.upper >= six.upper - 1e-15, "{class}");
            tighter += usize::from(six.lower > four.lower + 1e-3);
        }
    }
    // It is worth something.
    assert!(tighter > 60, "{tighter}");
}

/// Exact moments of up to three surfaces belong to them alone; a fourth is missed.
#[test]
fn up_to_three_surfaces_are_reproduced_and_a_fourth_is_not() {
    let mut random = ChaCha8Rng::seed_from_u64(63);
    let mut missed = 0.0_f64;
    for count in 1..=4 {
        for _ in 0..50 {
            let atoms: Vec<(f64, f64)> = (0..count)
                .map(|_| {
                    (
                        random.random_range(-1.0..=1.0),
                        random.random_range(0.1..=1.0),
                    )
                })
                .collect();
            let depth = random.random_range(-1.0..=1.0);
            let truth = Mixture::new(&atoms)
                .unwrap()
                .below(&rational(depth).unwrap());
            let lower = exact_hamburger(&atoms, 6, depth).lower;
            if count <= 3 {
                assert!((lower - truth).abs() < 1e-15, "{atoms:?} {depth}");
            } else {
                missed = missed.max(truth - lower);
            }
        }
    }
    assert!(missed > 0.1, "{missed}");
}
