//! Six moments: the only surface in front of a fragment, where its place is hardest to find.

use moment_shadows::{SixMomentsBias, Storage};
use moment_shadows_lab::oracle::{hamburger, rational, sensitivity, tolerance_unit};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::mixtures;
use super::six::{Input, biased, bounds, tolerance, truth};

/// Two surfaces far apart and a fragment just in front of the second one. By one over the distance from the fragment the second one is
/// far away from all else, and the first guess of the place of the first one is off by a part of that. The moment bias is the smallest for
/// which one step from there is enough.
#[test]
fn a_surface_far_in_front_of_the_fragment_is_found() {
    let bias = SixMomentsBias {
        alpha: 5e-5,
        ..Storage::Unorm16.six_moments_bias().unwrap()
    };
    let mut random = ChaCha8Rng::seed_from_u64(12);
    let inputs: Vec<Input> = (0..400)
        .map(|_| {
            let near = random.random_range(-1.0..=-0.94);
            let far = random.random_range(0.54..=0.58);
            let weight = random.random_range(0.2..=0.6);
            let atoms = [(near, weight), (far, 1.0 - weight)];
            let depth = far - random.random_range(0.002..=0.004);
            Input::new(biased(mixtures::moments(&atoms), &bias), depth, bias.alpha)
        })
        .collect();
    let (mut count, mut largest) = (0, 0.0_f64);
    for (input, [lower, ..]) in inputs.iter().zip(bounds(&inputs)) {
        let moments = input
            .moments()
            .map(|moment| rational(f64::from(moment)).unwrap());
        let depth = rational(f64::from(input.depth)).unwrap();
        let extremal = hamburger(&moments, &depth).unwrap();
        // Of two points in front, the bound is what the others leave.
        let in_front = extremal.points.iter().filter(|point| point.side.is_lt());
        if in_front.count() != 1 {
            continue;
        }
        let [unit, _] = sensitivity(&moments, &depth, &extremal)
            .unwrap()
            .map(tolerance_unit);
        count += 1;
        largest = largest.max((f64::from(lower) - extremal.lower).abs() / unit);
    }
    println!("{largest:.1} units of {count}");
    assert!(count > 100, "{count}");
    assert!(largest <= tolerance(bias.alpha), "{largest}");
}

/// Two surfaces and a fragment just beside one of them: the bound that takes the weights of both points on one side, that of the fragment
/// and the lone one's, whose errors add up where they ought to cancel.
#[test]
fn both_weights_beside_one_of_two_surfaces() {
    let mut random = ChaCha8Rng::seed_from_u64(13);
    for alpha in [1e-4, 5e-5] {
        let bias = SixMomentsBias {
            alpha,
            ..Storage::Unorm16.six_moments_bias().unwrap()
        };
        let inputs: Vec<Input> = (0..1500)
            .map(|_| {
                let places = [0, 1].map(|_| random.random_range(-1.0..=1.0));
                let weight = random.random_range(0.1..=0.9);
                let atoms = [(places[0], weight), (places[1], 1.0 - weight)];
                let aside = 10.0_f64.powf(random.random_range(-3.0..=-1.3));
                let depth = places[0] + if random.random() { aside } else { -aside };
                Input::new(biased(mixtures::moments(&atoms), &bias), depth, bias.alpha)
            })
            .collect();
        let mut errors: Vec<f64> = inputs
            .par_iter()
            .zip(bounds(&inputs))
            .map(|(input, [lower, upper, ..])| {
                let (exact, units) = truth(input, 6);
                let of =
                    |found: f32, side: usize| (f64::from(found) - exact[side]).abs() / units[side];
                of(lower, 0).max(of(upper, 1))
            })
            .collect();
        errors.sort_by(f64::total_cmp);
        let [most, largest] = [errors[errors.len() * 99 / 100], errors[errors.len() - 1]];
        println!("alpha {alpha:e}: {most:.1} units for 99 %, at most {largest:.1}");
        assert!(most <= tolerance(alpha), "{most}");
        // Of 4,000 the largest has 58; an emulation of single precision found 162 among hundreds of thousands.
        assert!(largest <= 128.0, "{largest}");
    }
}
