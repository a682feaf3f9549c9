//! Exponential variance shadow maps: lower bounds, the darker of two, within the exponents of the storages.

use moment_shadows::Storage;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::filtering::{filtered, patch, taps, variance_of};
use crate::mixture::{self, Input, limits};
use crate::wgsl_module::{constant, module};
use crate::{HALF_ULP, assert_smallest, chebyshev};

/// The storages that the technique has, with the largest exponent and the smallest variance per mean square. The latter is
/// what the module's text says, not what it should say.
fn storages() -> [(Storage, f64, f64); 2] {
    [(Storage::Float16, 5.54), (Storage::Float32, 40.0)].map(|(storage, limit)| {
        let name = storage.name().to_uppercase();
        let name = format!("EXPONENTIAL_VARIANCE_SMALLEST_{name}");
        let numbers = constant(&module("exponential_variance", &name), &name);
        (storage, limit, numbers[0])
    })
}

#[test]
fn both_bounds_are_chebyshevs_for_the_warped_depths() {
    for (storage, limit, floor) in storages() {
        let mut random = ChaCha8Rng::seed_from_u64(41);
        let inputs: Vec<Input> = (0..50_000)
            .map(|_| {
                let mut input = mixture::random(&mut random, storage);
                let mut exponent = || {
                    let share: f64 = random.random_range(0.0..1.2);
                    (limit * share.min(1.0)) as f32
                };
                input.exponents = [3.0, 9.0, exponent(), exponent()];
                input
            })
            .collect();
        let rounding = match storage {
            Storage::Float16 => 1.0 / f64::from(1 << 11),
            _ => 0.0,
        };
        let mut darker = 0;
        for (input, output) in inputs.iter().zip(mixture::run(&inputs)) {
            let interval = |sign: f64, exponent: f32| {
                let exponent = f64::from(exponent);
                let warp = |depth: f64| sign * (sign * exponent * depth).exp();
                let mean = input.mean(warp);
                let variance = input.mean(|depth| (warp(depth) - mean).powi(2));
                let square = input.mean(|depth| warp(depth).powi(2));
                let distance = warp(f64::from(input.fragment_depth)) - mean;
                // Relative errors of the mean (and of the fragment's own warp) and of the mean square: one rounding, eight sums.
                // One exponential warps all depths, so its own error of up to (3 + 2 c) units does not count as an error of the
                // moments; as an error of the warp it moves a depth by that over c, at most 6 units.
                let error = rounding + 12.0 * HALF_ULP;
                let depth_error = (3.0 + 2.0 * exponent) * 2.0 * HALF_ULP;
                // Below 2^-14 a float16 is off by 2^-25, and float32 flushes below 2^-126.
                let absolute = if storage == Storage::Float16 {
                    3e-8
                } else {
                    1e-37
                };
                let loss = 3.0 * error * square + depth_error * variance + 3.0 * absolute;
                let shift = (error + depth_error) * mean.abs()
                    + depth_error * warp(f64::from(input.fragment_depth)).abs()
                    + absolute;
                let floor = floor * square;
                let slack = 16.0 * HALF_ULP;
                let lower = chebyshev(
                    (variance + loss).max(floor * 1.01) + 4.0 * absolute,
                    distance - shift,
                );
                let upper = chebyshev((variance - loss).max(floor * 0.99), distance + shift);
                assert!(lower - slack <= input.truth(), "{input:?}");
                [lower - slack, upper + slack]
            };
            let positive = interval(1.0, input.exponents[2]);
            let negative = interval(-1.0, input.exponents[3]);
            let both = [positive[0].max(negative[0]), positive[1].max(negative[1])];
            let found = [output.exponential_variance_2, output.exponential_variance_4];
            for (found, [lower, upper]) in found.into_iter().zip([positive, both]) {
                assert!(
                    (lower..=upper).contains(&f64::from(found)),
                    "{storage}: {input:?} gave {found}, which is not from {lower} to {upper}"
                );
            }
            assert!(output.exponential_variance_4 >= output.exponential_variance_2);
            darker += usize::from(output.exponential_variance_4 > output.exponential_variance_2);
        }
        // The second warp is worth its channels.
        assert!(darker > inputs.len() / 10);
    }
}

#[test]
fn bounds_are_never_above_the_truth_in_float32() {
    let mut random = ChaCha8Rng::seed_from_u64(42);
    let inputs: Vec<Input> = (0..100_000)
        .map(|_| {
            let mut input = mixture::random(&mut random, Storage::Float32);
            input.exponents = [3.0, 9.0, 40.0, 5.0];
            input
        })
        .collect();
    let excess = |input: &Input, found: f32| f64::from(found) - input.truth();
    let mut excesses = [0.0_f64; 2];
    for (input, output) in inputs.iter().zip(mixture::run(&inputs)) {
        let found = [output.exponential_variance_2, output.exponential_variance_4];
        for (largest, found) in excesses.iter_mut().zip(found) {
            *largest = largest.max(excess(input, found));
        }
    }
    println!("excess over the truth: {excesses:?}");
    // Rounding leaves no variance wrong by more than a factor of 2, which the smallest variance is chosen for; that moves the
    // bound 1 / (1 + r) by 3 - 2 sqrt(2) at most.
    assert!(excesses.iter().all(|&excess| excess <= 0.172));
}

#[test]
fn exponents_are_as_large_as_the_storages_allow() {
    // Squares of both ends of a float32 are normal numbers with a weight of 2^-10 as well.
    let float32 = 58.0 * 2.0_f64.ln();
    assert!(2.0 * (2.0 * float32).exp() < f64::from(f32::MAX));
    assert!(
        (-2.0 * float32 - 10.0 * 2.0_f64.ln()).exp() >= f64::from(f32::MIN_POSITIVE) * (1.0 - 1e-9)
    );
    // The square of the far end is the largest float16.
    let float16 = 0.5 * 65504.0_f64.ln();
    for ((storage, limit, _), derived) in storages().into_iter().zip([float16, float32]) {
        assert_eq!(limits(storage).exponential_variance, limit as f32);
        println!("{storage}: {limit} of {derived:.4}");
        assert!(limit <= derived && derived - limit < 0.25);
    }
}

/// Beyond the largest float16 the mean square is cut off, and with it the variance: far fragments are too dark.
#[test]
fn beyond_its_range_a_storage_is_no_lower_bound() {
    let excess = |exponent: f32| {
        let mut input = Input::new(
            &[(0.0, 0.25), (0.5, 0.25), (1.0, 0.5)],
            0.9,
            Storage::Float16,
        );
        input.exponents = [3.0, 9.0, exponent, 1.0];
        let output = mixture::run(&[input])[0];
        let warp = |depth: f64| (f64::from(exponent) * depth).exp();
        let mean = input.mean(warp);
        let variance = input.mean(|depth| (warp(depth) - mean).powi(2));
        let distance = warp(f64::from(input.fragment_depth)) - mean;
        f64::from(output.exponential_variance_2) - chebyshev(variance, distance)
    };
    let found = [5.54, 6.5].map(excess);
    println!("excess over the bound: {found:?}");
    assert!(found[0].abs() < 0.01 && found[1] > 0.05);
}

/// The smallest variance, per mean square, is what a resolve and a two-pass blur take from the variance.
#[test]
fn the_smallest_variance_covers_three_roundings_to_each_storage() {
    for (storage, limit, floor) in storages() {
        for share in [0.25, 1.0] {
            let exponent = limit * share;
            let warp = |depth: f64| (exponent * depth).exp();
            let encoded = |depth: f64| {
                let warped = warp(depth) as f32;
                [warped, warped * warped, 0.0, 0.0]
            };
            let losses: Vec<f64> = (0..100_000_u64)
                .into_par_iter()
                .map(|seed| {
                    let depths = patch(&mut ChaCha8Rng::seed_from_u64(seed));
                    let [m1, m2, ..] = filtered(&depths, storage, encoded).map(f64::from);
                    let square: f64 = taps(&depths)
                        .map(|(weight, depth)| weight * warp(depth).powi(2))
                        .sum();
                    let absolute = if storage == Storage::Float16 {
                        9e-8
                    } else {
                        1e-37
                    };
                    (variance_of(&depths, warp) - (m2 - m1 * m1) - absolute) / square
                })
                .collect();
            assert_smallest(&format!("{storage} with {exponent:.2}"), losses, floor);
        }
    }
}
