//! Techniques without rounding: against the exact bounds, and never beyond the truth.

use moment_shadows::{Finite, LayerSplits, MapEncoding, Storage, Technique};
use moment_shadows_lab::oracle::ideal::Ideal;
use moment_shadows_lab::oracle::{Mixture, hamburger, hausdorff, rational};
use moment_shadows_lab::techniques;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::{exact_hamburger, exact_hausdorff, mixtures};

fn bound(technique: &Ideal, atoms: &[(f64, f64)], depth: f64) -> f64 {
    let total: f64 = atoms.iter().map(|atom| atom.1).sum();
    let normalised = atoms.iter().map(|&(depth, weight)| (depth, weight / total));
    let (depths, weights): (Vec<f64>, Vec<f64>) = normalised.unzip();
    technique.shadow_intensity(&depths, &weights, depth)
}

fn without_bias(technique: &Technique) -> Ideal {
    Ideal::of(technique, None).unwrap()
}

fn layered(layers: u32, overlap: f32) -> Technique {
    Technique::Lvsm {
        layers,
        overlap: Finite::new(overlap).unwrap(),
        splits: LayerSplits::Uniform,
    }
}

/// The exact bound of surfaces at a fragment depth.
type ExactBound = fn(&[(f64, f64)], f64) -> f64;

/// Moments in f64 are not exact, so what a rounding of 1e-16 makes of a bound is allowed: much for surfaces 1e-5 apart, and
/// next to nothing for others.
#[test]
fn power_moments_are_exact() {
    let exact: [(Technique, ExactBound); 4] = [
        (Technique::Vsm, |atoms, depth| {
            exact_hamburger(atoms, 2, depth).lower
        }),
        (Technique::Hamburger4, |atoms, depth| {
            exact_hamburger(atoms, 4, depth).lower
        }),
        (Technique::Hamburger6, |atoms, depth| {
            exact_hamburger(atoms, 6, depth).lower
        }),
        (Technique::Hausdorff4, |atoms, depth| {
            exact_hausdorff(atoms, 4, [-1.0, 1.0], depth).lower
        }),
    ];
    for (technique, exact) in exact {
        let ideal = without_bias(&technique);
        for class in mixtures::CLASSES {
            let mut random = ChaCha8Rng::seed_from_u64(11);
            for _ in 0..150 {
                let sample = mixtures::sample(class, &mut random);
                let depth = sample.fragment_depth;
                let error = bound(&ideal, &sample.atoms, depth) - exact(&sample.atoms, depth);
                assert!(error.abs() < 1e-7, "{technique}, {class}: {error:e}");
            }
        }
    }
}

/// The surfaces that stand for a bias make the moments that the bias makes.
#[test]
fn biased_moments_are_those_of_the_storage() {
    let mut random = ChaCha8Rng::seed_from_u64(14);
    let moved = |moments: Vec<f64>, alpha: f32, even: &[f32]| {
        let alpha = f64::from(alpha);
        let target = even.iter().flat_map(|&even| [0.0, f64::from(even)]);
        let moved = moments.iter().zip(target);
        let moved = moved.map(|(moment, target)| moment + alpha * (target - moment));
        Vec::from_iter(moved.map(|moment| rational(moment).unwrap()))
    };
    for storage in Storage::OF_FOUR_MOMENTS {
        for _ in 0..50 {
            // Surfaces apart, so that moments in f64 tell them apart.
            let mut random_part = |low: f64, high: f64| random.random_range(low..high);
            let atoms = [
                (random_part(-1.0, -0.5), random_part(0.2, 1.0)),
                (random_part(-0.3, 0.1), random_part(0.2, 1.0)),
                (random_part(0.3, 1.0), random_part(0.2, 1.0)),
            ];
            let depth = random_part(-0.9, 0.9);
            let moments = |count: usize| -> Vec<f64> {
                let exact = Mixture::new(&atoms).unwrap().moments(count);
                exact.iter().map(|moment| moment.to_f64().value()).collect()
            };
            let at = rational(depth).unwrap();
            let [low, high] = [-1.0, 1.0].map(|end| rational(end).unwrap());
            let (line, interval) = (storage.moment_bias(), storage.hausdorff_moment_bias());
            let six = storage.six_moments_bias().unwrap();
            let four = moved(moments(4), line.alpha, &[line.second, line.fourth]);
            let inside = [interval.second, interval.fourth];
            let inside = moved(moments(4), interval.alpha, &inside);
            let six = moved(moments(6), six.alpha, &six.even);
            for (technique, exact) in [
                (Technique::Hamburger4, hamburger(&four, &at).unwrap()),
                (
                    Technique::Hausdorff4,
                    hausdorff(&inside, [&low, &high], &at).unwrap(),
                ),
                (Technique::Hamburger6, hamburger(&six, &at).unwrap()),
            ] {
                let ideal = Ideal::of(&technique, Some(storage)).unwrap();
                let error = bound(&ideal, &atoms, depth) - exact.lower;
                assert!(error.abs() < 1e-6, "{technique}, {storage}: {error:e}");
            }
        }
    }
}

#[test]
fn no_bound_exceeds_the_truth() {
    let encodings = techniques::filterable();
    let ideals: Vec<(String, Ideal)> = encodings
        .iter()
        .map(|encoding| encoding.technique().clone())
        .chain([layered(8, 0.1), layered(1, 0.0)])
        .map(|technique| (techniques::described(&technique), without_bias(&technique)))
        .collect();
    let mut random = ChaCha8Rng::seed_from_u64(12);
    for class in mixtures::CLASSES {
        for _ in 0..500 {
            let sample = mixtures::sample(class, &mut random);
            let total: f64 = sample.atoms.iter().map(|atom| atom.1).sum();
            let anywhere = random.random_range(-1.0..=1.0);
            for depth in [sample.fragment_depth, sample.atoms[0].0, anywhere] {
                let in_front = sample.atoms.iter().filter(|atom| atom.0 < depth);
                let truth = in_front.map(|atom| atom.1).sum::<f64>() / total;
                for (name, ideal) in &ideals {
                    let bound = bound(ideal, &sample.atoms, depth);
                    assert!(bound >= 0.0, "{name}: {bound}");
                    // As for exactness. The table of series is rounded up to four digits.
                    assert!(
                        bound <= truth + 1e-7,
                        "{name}, {class}: {bound}, not {truth}"
                    );
                }
            }
        }
    }
}

#[test]
fn an_occluder_and_a_receiver_are_exact_with_two_moments_of_any_warp() {
    let exponent = |exponent: f32| Some(Finite::new(exponent).unwrap());
    let mut random = ChaCha8Rng::seed_from_u64(13);
    for _ in 0..1000 {
        let near = random.random_range(-1.0..0.8);
        let far = random.random_range(near + 0.05..1.0);
        let share = random.random_range(0.05..0.95);
        let atoms = [(near, share), (far, 1.0 - share)];
        for technique in [
            Technique::Vsm,
            Technique::Evsm2 {
                exponent: exponent(20.0),
            },
            layered(1, 0.0),
            Technique::Hamburger4,
            Technique::Hausdorff4,
        ] {
            let error = bound(&without_bias(&technique), &atoms, far) - share;
            // Warped distances reach e^40, which costs EVSM a few digits.
            assert!(error.abs() < 1e-9, "{technique}: {error:e}");
        }
    }
}

/// A layer that ends between two occluders does not know that there are two.
#[test]
fn layers_separate_occluders() {
    let atoms = [(-0.9, 0.3), (0.3, 0.2), (0.5, 0.5)];
    let [one, two] = [1, 2].map(|layers| bound(&without_bias(&layered(layers, 0.0)), &atoms, 0.5));
    assert!(one < 0.43 && two > one, "{one} {two}");
    // One layer of the whole range is as no layers at all.
    assert_eq!(one, bound(&without_bias(&Technique::Vsm), &atoms, 0.5));
}

#[test]
fn what_reads_depth_or_places_layers_has_no_ideal() {
    for technique in techniques::reading_depth() {
        assert_eq!(Ideal::of(&technique, None), None, "{technique}");
    }
    let placed = Technique::Lvsm {
        layers: 4,
        overlap: Finite::default(),
        splits: LayerSplits::Lloyd,
    };
    assert_eq!(Ideal::of(&placed, None), None);
    // A storage that a technique does not have.
    assert_eq!(Ideal::of(&Technique::Vsm, Some(Storage::Unorm8)), None);
    assert!(MapEncoding::new(Technique::Vsm, Storage::Unorm8).is_err());
}
