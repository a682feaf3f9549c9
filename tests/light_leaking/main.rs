//! What the moment bias costs: light behind an occluder, and how well two surfaces are told apart.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use bytemuck::{Pod, Zeroable};
use moment_shadows::{Profile, Storage};
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::oracle::{Mixture, hamburger, rational, sensitivity, tolerance_unit};

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Input {
    near: f32,
    far: f32,
    far_weight: f32,
    fragment_depth: f32,
    storage: u32,
    padding: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Output {
    biased: [f32; 4],
    intensity: f32,
    lower: f32,
    upper: f32,
    padding: f32,
}

/// Shadow intensities at which the leak is measured.
const LEVELS: [f64; 3] = [0.5, 0.9, 0.98];

/// The shader's number of a storage.
fn number(storage: Storage) -> u32 {
    match storage {
        Storage::Unorm16 => 0,
        Storage::Float16 => 1,
        _ => 2,
    }
}

fn run(inputs: &[Input]) -> Vec<Output> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    Batch::new(&gpu, "occluder.wgsl", include_str!("occluder.wgsl"))
        .unwrap()
        .run(inputs)
        .unwrap()
}

/// The distance behind an occluder at which the exact lower bound of the biased moments reaches a level.
fn exact_distance(occluder: f64, alpha: f64, beta: f64, level: f64) -> f64 {
    let moments = Mixture::new(&[(occluder, 1.0)])
        .unwrap()
        .biased(alpha, beta)
        .unwrap()
        .moments(4);
    let (mut low, mut high) = (0.0, 1.0);
    // To one part in a million of the distances that matter.
    for _ in 0..30 {
        let middle = 0.5 * (low + high);
        let depth = rational(occluder + middle).unwrap();
        if hamburger(&moments, &depth).unwrap().lower < level {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Distances measured by the oracle's authors for an occluder in the middle, printed with two digits.
#[test]
fn the_oracle_repeats_the_known_leak_of_each_moment_bias() {
    for (alpha, beta, distances) in [
        (3e-7, 0.375, [0.00034, 0.0010, 0.0024]),
        (1e-6, 0.375, [0.00061, 0.0018, 0.0043]),
        (6e-5, 0.628, [0.0061, 0.018, 0.043]),
        (1.2e-4, 0.628, [0.0087, 0.026, 0.061]),
        (1e-3, 0.628, [0.025, 0.075, 0.17]),
        (3.5e-3, 0.628, [0.047, 0.14, 0.31]),
    ] {
        for (level, expected) in LEVELS.into_iter().zip(distances) {
            let distance = exact_distance(0.0, alpha, beta, level);
            assert!(
                (distance / expected - 1.0).abs() < 0.1,
                "alpha {alpha}, level {level}: {distance} instead of {expected}"
            );
        }
    }
}

#[test]
fn the_leak_behind_an_occluder_follows_the_exact_curve_for_each_storage() {
    /// Steps of a tenth of a percent.
    const STEP: f64 = 1.001;
    const STEPS: usize = 9000;
    for storage in Storage::ALL {
        let bias = storage.moment_bias();
        let (alpha, beta) = (f64::from(bias.alpha), f64::from(bias.beta));
        for occluder in [-0.5, -0.25, 0.0, 0.125, 0.5] {
            let distance = |step: usize| 1e-4 * STEP.powi(i32::try_from(step).unwrap());
            let inputs: Vec<Input> = (0..STEPS)
                .take_while(|&step| occluder + distance(step) <= 1.0)
                .map(|step| Input {
                    near: occluder as f32,
                    far: 0.0,
                    far_weight: 0.0,
                    fragment_depth: (occluder + distance(step)) as f32,
                    storage: number(storage),
                    padding: 0,
                })
                .collect();
            let outputs = run(&inputs);
            for level in LEVELS {
                let step = outputs
                    .iter()
                    .position(|output| f64::from(output.intensity) >= level)
                    .unwrap();
                let expected = exact_distance(occluder, alpha, beta, level);
                let ratio = distance(step) / expected;
                println!(
                    "{storage:<8} occluder {occluder:6.3}, level {level:4}: {:.5}, exact {expected:.5}, ratio {ratio:.3}",
                    distance(step)
                );
            }
        }
    }
}

#[test]
fn two_surfaces_far_apart_give_the_two_step_function() {
    let mut inputs = Vec::new();
    for gap in [0.7, 0.9, 1.3, 1.9] {
        for middle in [-0.6, -0.3, 0.0, 0.2, 0.55] {
            let (near, far) = (middle - 0.5 * gap, middle + 0.5 * gap);
            if near < -1.0 || far > 1.0 {
                continue;
            }
            for far_weight in [0.1, 0.25, 0.5, 0.75, 0.9] {
                for step in 0..=400 {
                    let depth = -1.0 + 0.005 * f64::from(step);
                    if (depth - near).abs() < 0.05 || (depth - far).abs() < 0.05 {
                        continue;
                    }
                    inputs.push(Input {
                        near: near as f32,
                        far: far as f32,
                        far_weight: far_weight as f32,
                        fragment_depth: depth as f32,
                        storage: number(Storage::Float32),
                        padding: 0,
                    });
                }
            }
        }
    }
    let outputs = run(&inputs);
    let mut worst = (0.0, inputs[0]);
    for (input, output) in inputs.iter().zip(&outputs) {
        let truth = if input.fragment_depth <= input.near {
            0.0
        } else if input.fragment_depth <= input.far {
            1.0 - input.far_weight
        } else {
            1.0
        };
        let error = (output.intensity - truth).abs();
        if error > worst.0 {
            worst = (error, *input);
        }
    }
    println!("largest error {:.2e} at {:?}", worst.0, worst.1);
    assert!(worst.0 <= 1e-3);
}

/// Surfaces that no four moments tell apart: what remains is the exact bound, no more and no less.
#[test]
fn two_surfaces_close_together_give_the_exact_bounds_of_their_biased_moments() {
    let mut inputs = Vec::new();
    for storage in Storage::ALL {
        for gap in [0.5, 0.2, 0.05, 0.01, 1e-3] {
            for middle in [-0.7, -0.1, 0.4] {
                for far_weight in [0.1, 0.5, 0.75] {
                    for step in -10..=10 {
                        let depth = middle + gap * 0.23 * f64::from(step);
                        inputs.push(Input {
                            near: (middle - 0.5 * gap) as f32,
                            far: (middle + 0.5 * gap) as f32,
                            far_weight,
                            fragment_depth: depth.clamp(-1.0, 1.0) as f32,
                            storage: number(storage),
                            padding: 0,
                        });
                    }
                }
            }
        }
    }
    let outputs = run(&inputs);
    let mut largest = 0.0_f64;
    for (input, output) in inputs.iter().zip(&outputs) {
        let moments: Vec<_> = output
            .biased
            .iter()
            .map(|&moment| rational(f64::from(moment)).unwrap())
            .collect();
        let depth = rational(f64::from(input.fragment_depth)).unwrap();
        let exact = hamburger(&moments, &depth).unwrap();
        let [lower, upper] = sensitivity(&moments, &depth, &exact)
            .unwrap()
            .map(tolerance_unit);
        for (value, truth, unit) in [
            (output.lower, exact.lower, lower),
            (output.intensity, exact.lower, lower),
            (output.upper, exact.upper, upper),
        ] {
            largest = largest.max((f64::from(value) - truth).abs() / unit);
        }
    }
    println!("largest error {largest:.2} units");
    // As for all moments: 8 units of 2^-24 (1 + sensitivity).
    assert!(largest <= 8.0);
}
