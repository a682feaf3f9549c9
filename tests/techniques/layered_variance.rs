//! Layered variance shadow maps: variance shadow maps to the bit with one layer, exact where a split separates surfaces.

use moment_shadows::Storage;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::mixture::{self, Input, Layers};
use crate::{HALF_ULP, chebyshev};

#[test]
fn one_layer_is_variance_shadow_mapping_to_the_bit() {
    for storage in Storage::OF_FOUR_MOMENTS {
        let mut random = ChaCha8Rng::seed_from_u64(45);
        let inputs: Vec<Input> = (0..50_000)
            .map(|_| {
                let mut input = mixture::random(&mut random, storage);
                input.layers = Layers::new(&[], random.random_range(0.0..0.2));
                input
            })
            .collect();
        for (input, output) in inputs.iter().zip(mixture::run(&inputs)) {
            assert_eq!(
                output.layered.to_bits(),
                output.variance.to_bits(),
                "{storage}: {input:?} gave {output:?}"
            );
        }
    }
}

#[test]
fn a_split_between_occluders_and_receiver_makes_the_receiver_exact() {
    let mut random = ChaCha8Rng::seed_from_u64(46);
    let mut inputs = Vec::new();
    while inputs.len() < 2000 {
        let split = random.random_range(-0.75..0.75_f32);
        // Occluders anywhere in front of the split: with one layer light bleeds between them.
        let occluders: Vec<(f32, f32)> = (0..4)
            .map(|_| (random.random_range(-1.0..=split), 0.125))
            .collect();
        let receiver = random.random_range(split + 0.1..=1.0);
        let mut surfaces = occluders;
        surfaces.push((receiver, 0.5));
        let mut input = Input::new(&surfaces, receiver, Storage::Float32);
        input.layers = Layers::new(&[split], 0.0);
        inputs.push(input);
    }
    let mut bleeding = 0.0_f32;
    for (input, output) in inputs.iter().zip(mixture::run(&inputs)) {
        // Two surfaces at least 0.1 apart of a layer at most 1.75 wide: a variance of 0.25 (0.1 / 0.875)^2 = 3e-3 with an error
        // of some units of 2^-24, which the intensity has a quarter of, relative.
        let error = (f64::from(output.layered) - input.truth()).abs();
        assert!(
            error <= 0.25 * 24.0 * HALF_ULP / 3e-3,
            "{input:?}: {error:e}"
        );
        bleeding = bleeding.max(0.5 - output.variance);
    }
    // One layer leaks there.
    assert!(bleeding > 0.1, "{bleeding}");
}

#[test]
fn the_darkest_layer_bounds_the_truth_from_below() {
    for storage in Storage::OF_FOUR_MOMENTS {
        let mut random = ChaCha8Rng::seed_from_u64(47);
        let inputs: Vec<Input> = (0..50_000)
            .map(|_| {
                let mut input = mixture::random(&mut random, storage);
                let count = random.random_range(0..=7);
                let mut splits: Vec<f32> = (0..count)
                    .map(|_| random.random_range(-1.0..=1.0))
                    .collect();
                splits.sort_by(f32::total_cmp);
                input.layers = Layers::new(&splits, random.random_range(0.0..0.1));
                input
            })
            .collect();
        let (floor, first, second) = match storage {
            Storage::Unorm16 => (6e-5, 1.0 / 65535.0, 0.5 / 65535.0),
            Storage::Float16 => (1e-3, 2.0 / 8192.0, 1.0 / 8192.0),
            _ => (5e-7, 0.0, 0.0),
        };
        for (input, output) in inputs.iter().zip(mixture::run(&inputs)) {
            let expected = Expected::new(input);
            let mut interval = [0.0; 2];
            for layer in 0..=expected.splits.len() {
                let [p, q] = expected.interval(layer);
                // The warp multiplies an error of depth, 2^-24 for its difference from the middle, by the inverse half width.
                let half = (0.5 * (q - p)).max(1e-4);
                let warp = |depth: f64| ((depth - 0.5 * (p + q)) / half).clamp(-1.0, 1.0);
                let mean = input.mean(warp);
                let variance = input.mean(|depth| (warp(depth) - mean).powi(2));
                let distance = warp(f64::from(input.fragment_depth)) - mean;
                let arithmetic = (12.0 + 4.0 / half) * HALF_ULP;
                let (first, second) = (first + arithmetic, second + 2.0 * arithmetic);
                let loss = second + 2.0 * first + first * first;
                let lower = chebyshev((variance + loss).max(floor), distance - 2.0 * first);
                let upper = chebyshev((variance - loss).max(floor), distance + 2.0 * first);
                assert!(lower <= input.truth() + 8.0 * HALF_ULP, "{input:?}");
                interval[0] = f64::max(interval[0], lower);
                interval[1] = f64::max(interval[1], upper);
            }
            let slack = 8.0 * HALF_ULP;
            let found = f64::from(output.layered);
            assert!(
                interval[0] - slack <= found && found <= interval[1] + slack,
                "{storage}: {input:?} gave {found}, which is not in {interval:?}"
            );
        }
    }
}

/// Layers as the definition has them.
struct Expected {
    splits: Vec<f64>,
    overlap: f64,
}

impl Expected {
    fn new(input: &Input) -> Self {
        let count = input.layers.count as usize - 1;
        let splits: Vec<f64> = input.layers.splits[..count]
            .iter()
            .map(|&split| f64::from(split))
            .collect();
        let overlap = f64::from(input.layers.overlap);
        Self { splits, overlap }
    }

    fn interval(&self, layer: usize) -> [f64; 2] {
        let front = layer
            .checked_sub(1)
            .map(|front| self.splits[front] - self.overlap);
        let back = self.splits.get(layer).map(|split| split + self.overlap);
        [
            front.unwrap_or(-1.0).max(-1.0),
            back.unwrap_or(1.0).min(1.0),
        ]
    }
}
