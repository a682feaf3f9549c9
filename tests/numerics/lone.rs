//! Six moments: the only surface in front of a fragment, where its place is hardest to find.

use moment_shadows::{SixMomentsBias, Storage};
use moment_shadows_lab::oracle::{hamburger, rational, sensitivity, tolerance_unit};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::mixtures;
use super::six::{Input, biased, bounds, tolerance};

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
