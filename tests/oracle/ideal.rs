//! Techniques without errors: against the exact bounds, and never beyond the truth.

use moment_shadows_lab::oracle::ideal::{FourierSeries, Ideal};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::{exact_hamburger, exact_hausdorff, mixtures, normalised};

fn bound(technique: &Ideal, atoms: &[(f64, f64)], depth: f64) -> f64 {
    let (depths, weights): (Vec<f64>, Vec<f64>) = normalised(atoms).into_iter().unzip();
    technique.lower_bound(&depths, &weights, depth)
}

fn truth(atoms: &[(f64, f64)], depth: f64) -> f64 {
    normalised(atoms)
        .iter()
        .filter(|atom| atom.0 < depth)
        .map(|atom| atom.1)
        .sum()
}

/// The exact bound of surfaces at a fragment depth.
type ExactBound = fn(&[(f64, f64)], f64) -> f64;

/// Moments in f64 are not exact, so what a rounding of 1e-16 makes of a bound is allowed: much for surfaces 1e-5 apart, and
/// next to nothing for others.
#[test]
fn power_moments_are_exact() {
    let exact: [(Ideal, ExactBound); 4] = [
        (Ideal::Vsm, |atoms, depth| {
            exact_hamburger(atoms, 2, depth).lower
        }),
        (Ideal::Hamburger4, |atoms, depth| {
            exact_hamburger(atoms, 4, depth).lower
        }),
        (Ideal::Hamburger6, |atoms, depth| {
            exact_hamburger(atoms, 6, depth).lower
        }),
        (Ideal::Hausdorff4, |atoms, depth| {
            exact_hausdorff(atoms, 4, [-1.0, 1.0], depth).lower
        }),
    ];
    for (technique, exact) in exact {
        for class in mixtures::CLASSES {
            let mut random = ChaCha8Rng::seed_from_u64(11);
            let mut largest = 0.0_f64;
            for _ in 0..150 {
                let sample = mixtures::sample(class, &mut random);
                let depth = sample.fragment_depth;
                let error = bound(&technique, &sample.atoms, depth) - exact(&sample.atoms, depth);
                largest = largest.max(error.abs());
            }
            println!("{technique}, {class}: {largest:.1e}");
            assert!(largest < 1e-7, "{technique}, {class}: {largest:e}");
        }
    }
}

#[test]
fn no_bound_exceeds_the_truth() {
    let mut techniques = vec![
        Ideal::Vsm,
        Ideal::Esm { exponent: 40.0 },
        Ideal::Evsm2 { exponent: 40.0 },
        Ideal::Evsm2 { exponent: 300.0 },
        Ideal::Evsm4 {
            positive: 40.0,
            negative: 5.0,
        },
        Ideal::Lvsm {
            layers: 1,
            overlap: 0.0,
        },
        Ideal::Lvsm {
            layers: 8,
            overlap: 0.1,
        },
        Ideal::Hamburger4,
        Ideal::Hamburger6,
        Ideal::Hausdorff4,
    ];
    for terms in [1, 2, 4, 8, 16, 64] {
        for damping in [0.0, 0.5, 1.0, 4.0] {
            techniques.push(Ideal::Convolution(FourierSeries::new(terms, damping)));
        }
    }
    let mut random = ChaCha8Rng::seed_from_u64(12);
    for class in mixtures::CLASSES {
        for _ in 0..500 {
            let sample = mixtures::sample(class, &mut random);
            for depth in [
                sample.fragment_depth,
                sample.atoms[0].0,
                random.random_range(-1.0..=1.0),
            ] {
                let truth = truth(&sample.atoms, depth);
                for technique in &techniques {
                    let bound = bound(technique, &sample.atoms, depth);
                    assert!(bound >= 0.0, "{technique}: {bound}");
                    // As for exactness.
                    assert!(
                        bound <= truth + 1e-7,
                        "{technique}, {class}: {bound}, not {truth}"
                    );
                }
            }
        }
    }
}

#[test]
fn variance_shadow_maps_are_exact_for_an_occluder_and_a_receiver() {
    let mut random = ChaCha8Rng::seed_from_u64(13);
    for _ in 0..1000 {
        let near = random.random_range(-1.0..0.8);
        let far = random.random_range(near + 0.05..1.0);
        let share = random.random_range(0.05..0.95);
        let atoms = [(near, share), (far, 1.0 - share)];
        for technique in [
            Ideal::Vsm,
            Ideal::Evsm2 { exponent: 20.0 },
            Ideal::Lvsm {
                layers: 1,
                overlap: 0.0,
            },
            Ideal::Hamburger4,
            Ideal::Hausdorff4,
        ] {
            let error = bound(&technique, &atoms, far) - share;
            // Warped distances reach e^40, which costs EVSM a few digits.
            assert!(error.abs() < 1e-9, "{technique}: {error:e}");
        }
    }
}

/// A layer that ends between two occluders does not know that there are two.
#[test]
fn layers_separate_occluders() {
    let atoms = [(-0.9, 0.3), (0.3, 0.2), (0.5, 0.5)];
    let layered = Ideal::Lvsm {
        layers: 2,
        overlap: 0.0,
    };
    assert!(bound(&Ideal::Vsm, &atoms, 0.5) < 0.43);
    assert!(bound(&layered, &atoms, 0.5) > bound(&Ideal::Vsm, &atoms, 0.5));
    // One layer of the whole range is as no layers at all.
    let one = Ideal::Lvsm {
        layers: 1,
        overlap: 0.0,
    };
    assert_eq!(bound(&one, &atoms, 0.5), bound(&Ideal::Vsm, &atoms, 0.5));
}

#[test]
fn a_long_series_is_the_step() {
    // Without damping 200 terms are within 0.001 of it a tenth of the range away.
    let plain = FourierSeries::new(200, 0.0);
    assert!((plain.shadow(0.5)).abs() < 1e-3 && (plain.shadow(-0.5) - 1.0).abs() < 1e-3);
    assert!((plain.shadow(0.0) - 0.5).abs() < 1e-12);
    // As a bound it approaches the truth up to the ringing that is subtracted, 2 % with this damping.
    let atoms = [(-0.5, 0.4), (0.5, 0.6)];
    let [few, some, many] = [4, 16, 256].map(|terms| {
        let technique = Ideal::Convolution(FourierSeries::new(terms, 1.0));
        bound(&technique, &atoms, 0.0)
    });
    println!("{few} {some} {many}");
    assert!(few < some && some < 0.4, "{few} {some}");
    assert!((many - 0.38).abs() < 0.01, "{many}");
}
