//! Six moments without errors of storage: never looser than four of the same distribution, and exact for three surfaces.

use moment_shadows_lab::oracle::ideal::Ideal;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::{exact_hamburger, mixtures, normalised};

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

#[test]
fn in_f64_the_order_holds_for_very_many() {
    let mut random = ChaCha8Rng::seed_from_u64(62);
    for class in mixtures::CLASSES {
        for _ in 0..50_000 {
            let sample = mixtures::sample(class, &mut random);
            let (depths, weights): (Vec<f64>, Vec<f64>) =
                normalised(&sample.atoms).into_iter().unzip();
            let [four, six] = [Ideal::Hamburger4, Ideal::Hamburger6]
                .map(|technique| technique.lower_bound(&depths, &weights, sample.fragment_depth));
            // The bounds of surfaces 1e-5 apart amplify rounding.
            assert!(
                four <= six + 1e-7,
                "{class}: {four} {six} for {:?} {}",
                sample.atoms,
                sample.fragment_depth
            );
        }
    }
}

#[test]
fn in_f64_up_to_three_surfaces_are_reproduced_and_a_fourth_is_not() {
    let mut random = ChaCha8Rng::seed_from_u64(63);
    let mut missed = 0.0_f64;
    for count in 1..=4 {
        let mut tried = 0;
        while tried < 2000 {
            let mut depths: Vec<f64> = (0..count)
                .map(|_| random.random_range(-1.0..=1.0))
                .collect();
            let weights: Vec<f64> = (0..count).map(|_| random.random_range(0.1..=1.0)).collect();
            let fragment: f64 = random.random_range(-1.0..=1.0);
            depths.sort_by(f64::total_cmp);
            // Moments in f64 cannot tell surfaces or a fragment apart that are closer than this.
            let apart = depths.windows(2).all(|pair| pair[1] - pair[0] > 0.1)
                && depths.iter().all(|depth| (depth - fragment).abs() > 0.05);
            if !apart {
                continue;
            }
            tried += 1;
            let sum: f64 = weights.iter().sum();
            let weights: Vec<f64> = weights.iter().map(|weight| weight / sum).collect();
            let truth: f64 = depths
                .iter()
                .zip(&weights)
                .filter(|(depth, _)| **depth < fragment)
                .map(|(_, weight)| weight)
                .sum();
            let bound = Ideal::Hamburger6.lower_bound(&depths, &weights, fragment);
            if count <= 3 {
                // Three surfaces 0.1 apart leave pivots of about 1e-8 of 1e-16, and the fragment's distance squares the rest.
                assert!(
                    (bound - truth).abs() < 1e-5,
                    "{depths:?} {fragment}: {bound} {truth}"
                );
            } else {
                missed = missed.max(truth - bound);
            }
        }
    }
    assert!(missed > 0.1, "{missed}");
}
