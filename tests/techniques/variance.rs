//! Variance shadow maps: exact for one occluder, bleeding as published for two, a lower bound always.

use moment_shadows::Storage;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::filtering::{filtered, patch, variance_of};
use crate::mixture::{self, Input};
use crate::wgsl_module::{constant, module};
use crate::{HALF_ULP, assert_smallest, chebyshev};

/// The module's own constants: what its text says, not what it should say.
fn smallest(storage: Storage) -> f64 {
    let name = format!(
        "TWO_MOMENTS_SMALLEST_VARIANCE_{}",
        storage.name().to_uppercase()
    );
    let [smallest] = constant(&module("two_moments", &name), &name)[..] else {
        panic!("{name} is one number");
    };
    smallest
}

/// Largest errors of mean and mean square by one rounding, and by f32 arithmetic before it.
fn rounding(storage: Storage) -> [f64; 2] {
    let [first, second] = match storage {
        Storage::Unorm16 => [2.0 * 0.5 / 65535.0, 0.5 / 65535.0],
        Storage::Float16 => [2.0 / f64::from(1 << 13), 1.0 / f64::from(1 << 13)],
        _ => [0.0; 2],
    };
    // Eight products and sums of numbers up to 1, a basis and its inverse.
    [first, second].map(|error| error + 12.0 * HALF_ULP)
}

#[test]
fn one_occluder_and_one_receiver_are_as_percentage_closer_filtering_has_them() {
    let mut inputs = Vec::new();
    for occluder in [-1.0_f32, -0.75, -0.25, 0.5] {
        for gap in [0.25_f32, 0.5] {
            for share in [1, 512, 1024, 2048, 3072, 4095] {
                let share = share as f32 / 4096.0;
                let receiver = occluder + gap;
                let surfaces = [(occluder, share), (receiver, 1.0 - share)];
                inputs.push(Input::new(&surfaces, receiver, Storage::Float32));
            }
        }
    }
    for (input, output) in inputs.iter().zip(mixture::run(&inputs)) {
        // Depths and weights are multiples of 2^-12: moments, and the variance with them, are exact in f32. The smallest
        // variance raises that of the slightest share, 2^-12 2^-4, by nothing; what is left is three roundings.
        let error = (f64::from(output.variance) - input.truth()).abs();
        assert!(error <= 4.0 * HALF_ULP, "{input:?}: off by {error:e}");
    }
}

#[test]
fn light_bleeding_is_that_of_the_thesis() {
    let mut random = ChaCha8Rng::seed_from_u64(34);
    let inputs: Vec<Input> = (0..1000)
        .map(|_| {
            let dx = random.random_range(0.1..0.9_f32);
            let dy = random.random_range(0.0..0.9_f32);
            let first = random.random_range(-1.0..=1.0 - dx - dy);
            let surfaces = [(first, 0.5), (first + dx, 0.5)];
            Input::new(&surfaces, first + dx + dy, Storage::Float32)
        })
        .collect();
    let mut largest = 0.0_f64;
    for (input, output) in inputs.iter().zip(mixture::run(&inputs)) {
        let [first, second] = [input.depths[0], input.depths[1]].map(f64::from);
        let (dx, dy) = (second - first, f64::from(input.fragment_depth) - second);
        // Equation 3.4, where half of the filter region is covered by each of two occluders.
        let visibility = 0.25 * dx * dx / (0.5 * dx * dx + dx * dy + dy * dy);
        largest = largest.max((1.0 - f64::from(output.variance) - visibility).abs());
    }
    println!("bleeding is off by {largest:.1e} at most");
    assert!(largest <= 1e-4);
}

#[test]
fn the_bound_is_chebyshevs_and_nothing_in_front_of_the_mean() {
    for storage in Storage::OF_FOUR_MOMENTS {
        let mut random = ChaCha8Rng::seed_from_u64(35);
        let inputs: Vec<Input> = (0..50_000)
            .map(|_| mixture::random(&mut random, storage))
            .collect();
        let [first, second] = rounding(storage);
        let floor = smallest(storage);
        for (input, output) in inputs.iter().zip(mixture::run(&inputs)) {
            let mean = input.mean(|depth| depth);
            let variance = input.mean(|depth| (depth - mean).powi(2));
            let distance = f64::from(input.fragment_depth) - mean;
            // The bound for the moments that rounding can have made of these.
            let loss = second + 2.0 * first + first * first;
            let slack = 8.0 * HALF_ULP;
            let lower = chebyshev((variance + loss).max(floor), distance - first) - slack;
            let upper = chebyshev((variance - loss).max(floor), distance + first) + slack;
            let found = f64::from(output.variance);
            assert!(
                (lower..=upper).contains(&found),
                "{storage}: {input:?} gave {found}, which is not from {lower} to {upper}"
            );
            // The truth is between both bounds but for what rounding makes of them.
            assert!(lower - slack <= input.truth(), "{input:?}");
            if distance < -first {
                assert_eq!(output.variance, 0.0, "{input:?}");
            }
            if distance > first {
                assert_eq!(output.variance_upper, 1.0, "{input:?}");
            }
            let mirrored = chebyshev((variance - loss).max(floor), first - distance) + slack;
            assert!(f64::from(output.variance_upper) >= 1.0 - mirrored);
        }
    }
}

/// The smallest variance of a storage is what a resolve and a two-pass blur take from the variance, each stage rounded.
#[test]
fn the_smallest_variance_covers_three_roundings_to_each_storage() {
    for storage in Storage::OF_FOUR_MOMENTS {
        let encoded = |depth: f64| {
            let (z, square) = (depth as f32, depth as f32 * depth as f32);
            match storage {
                Storage::Unorm16 => [0.5 * z + 0.5, 1.0 - square, 0.0, 0.0],
                Storage::Float16 => [0.5 * z, 0.5 - square, 0.0, 0.0],
                _ => [z, square, 0.0, 0.0],
            }
        };
        let losses: Vec<f64> = (0..200_000_u64)
            .into_par_iter()
            .map(|seed| {
                let depths = patch(&mut ChaCha8Rng::seed_from_u64(seed));
                let [r, g, ..] = filtered(&depths, storage, encoded).map(f64::from);
                let [b1, b2] = match storage {
                    Storage::Unorm16 => [2.0 * r - 1.0, 1.0 - g],
                    Storage::Float16 => [2.0 * r, 0.5 - g],
                    _ => [r, g],
                };
                variance_of(&depths, |depth| depth) - (b2 - b1 * b1)
            })
            .collect();
        assert_smallest(storage.name(), losses, smallest(storage));
    }
}
