//! The blur on the device against a separable filter in double precision.

#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use moment_shadows::{Kernel, Storage};
use moment_shadows_lab::cost::blur::{BlurredMap, PROFILE};
use moment_shadows_lab::cost::reference;
use moment_shadows_lab::cost::texels::{Channels, decode, encode, noise, step};
use moment_shadows_lab::gpu::Gpu;

/// No multiples of a workgroup, of 8 or of 16 outputs; not square; wider than the largest kernel.
const SIZE: [u32; 2] = [203, 157];

fn open() -> Gpu {
    Gpu::open(PROFILE).unwrap()
}

fn texels(size: [u32; 2]) -> usize {
    size[0] as usize * size[1] as usize
}

/// Weights without any symmetry, of which some are zero: a kernel that is mirrored or shifted by one shows.
fn asymmetric(radius: u32) -> Kernel {
    let weights: Vec<f32> = (0..=2 * radius)
        .map(|tap| ((tap * 7 + 3) % 5) as f32 * (1.0 + tap as f32))
        .collect();
    Kernel::from_weights(&weights).unwrap()
}

fn gaussian(radius: u32) -> Kernel {
    Kernel::gaussian(radius, 0.6 * radius as f32).unwrap()
}

fn blurred(
    gpu: &Gpu,
    storage: Storage,
    size: [u32; 2],
    channels: &[[f64; 4]],
    kernel: &Kernel,
    per_frame: bool,
) -> Channels {
    BlurredMap::new(gpu, storage, size, channels, kernel.clone(), per_frame)
        .unwrap()
        .run(gpu)
        .unwrap()
}

fn largest_difference(a: &[[f64; 4]], b: &[[f64; 4]]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter()
        .flatten()
        .zip(b.iter().flatten())
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, |largest, difference| {
            // `f64::max` would drop NaN.
            if difference.is_nan() || difference > largest {
                difference
            } else {
                largest
            }
        })
}

/// Noise and a kernel without symmetry leave no texel and no weight that could be wrong unseen. Radius 12 is the last with
/// literal weights, 13 the first with uniform ones.
#[test]
fn every_radius_and_storage_gives_the_separable_filter() {
    let gpu = open();
    for storage in Storage::OF_FOUR_MOMENTS {
        let channels = noise(storage, texels(SIZE));
        for radius in [1, 4, 12, 13, 64] {
            for kernel in [asymmetric(radius), gaussian(radius)] {
                let map = BlurredMap::new(&gpu, storage, SIZE, &channels, kernel, false).unwrap();
                map.difference(&gpu, &channels)
                    .and_then(|difference| difference.accepted("it"))
                    .unwrap_or_else(|error| panic!("{storage}, radius {radius}: {error}"));
            }
        }
    }
}

/// The smallest maps that a kernel fits into: every texel's kernel reaches over both borders, and invocations end within
/// their block.
#[test]
fn borders_repeat_the_last_texel() {
    let gpu = open();
    let storage = Storage::Float32;
    for (radius, size) in [
        (1, [3, 4]),
        (4, [9, 17]),
        (12, [33, 25]),
        (13, [27, 33]),
        (64, [131, 129]),
    ] {
        for per_frame in [false, true] {
            let channels = noise(storage, texels(size));
            let map = BlurredMap::new(
                &gpu,
                storage,
                size,
                &channels,
                asymmetric(radius),
                per_frame,
            )
            .unwrap();
            map.difference(&gpu, &channels)
                .and_then(|difference| difference.accepted("it"))
                .unwrap_or_else(|error| panic!("radius {radius} of {size:?}: {error}"));
        }
    }
}

/// A single bright texel shows the kernel itself: where its weights lie, and that x and y are not exchanged.
#[test]
fn an_impulse_shows_the_weights_in_place() {
    let gpu = open();
    let [width, height] = [61_usize, 47];
    let centre = [23_usize, 31];
    let kernel = asymmetric(5);
    let weights = kernel.weights();
    let mut channels = vec![[0.0; 4]; width * height];
    channels[centre[1] * width + centre[0]] = [1.0, 0.5, 0.25, 0.125];
    for per_frame in [false, true] {
        let size = [width as u32, height as u32];
        let output = blurred(&gpu, Storage::Float32, size, &channels, &kernel, per_frame);
        for (index, texel) in output.iter().enumerate() {
            // Output at p takes the texel at p + tap - radius with weight tap.
            let weight = |position: usize, centre: usize| {
                (centre + 5)
                    .checked_sub(position)
                    .and_then(|tap| weights.get(tap))
                    .map_or(0.0, |&weight| f64::from(weight))
            };
            let expected = weight(index % width, centre[0]) * weight(index / width, centre[1]);
            // Two products, each rounded to single precision.
            let tolerance = 2.0 * step(Storage::Float32) * expected;
            assert!(
                (texel[0] - expected).abs() <= tolerance,
                "texel {index}: {} instead of {expected}",
                texel[0]
            );
        }
    }
}

/// Literal and uniform weights are two shaders of one filter. Their sums differ in the order of nothing but zeros, so only
/// what a compiler contracts can differ: a rounding of the storage in either direction.
#[test]
fn weights_per_frame_give_what_literal_weights_give() {
    let gpu = open();
    for storage in Storage::OF_FOUR_MOMENTS {
        let channels = noise(storage, texels(SIZE));
        for radius in [1, 4, 12] {
            let kernel = asymmetric(radius);
            let literal = blurred(&gpu, storage, SIZE, &channels, &kernel, false);
            let uniform = blurred(&gpu, storage, SIZE, &channels, &kernel, true);
            let difference = largest_difference(&literal, &uniform);
            let tolerance = 2.0 * reference::blur_tolerance(storage, &kernel);
            assert!(
                difference <= tolerance,
                "{storage}, radius {radius}: {difference:e} > {tolerance:e}"
            );
        }
    }
}

/// A filter whose weights do not sum to one darkens or brightens what is flat, and acts like a wrong moment everywhere.
/// 16-bit storage has to keep a constant map to the bit or within one step, single precision within its sum's rounding.
#[test]
fn a_constant_map_stays_constant() {
    let gpu = open();
    let size = [97, 70];
    for storage in Storage::OF_FOUR_MOMENTS {
        let centre = if storage == Storage::Float16 {
            0.5
        } else {
            0.0
        };
        let texel = [0.9, 0.321, 0.5, 1.0].map(|channel| channel - centre);
        let channels = vec![texel; texels(size)];
        let stored = decode(storage, &encode(storage, &channels));
        for (radius, per_frame) in [(1, false), (4, false), (12, false), (12, true), (30, false)] {
            for kernel in [gaussian(radius), asymmetric(radius)] {
                let output = blurred(&gpu, storage, size, &channels, &kernel, per_frame);
                let difference = largest_difference(&output, &stored);
                let taps = f64::from(2 * radius + 1);
                let allowed = match storage {
                    Storage::Float32 => taps * step(storage),
                    // A sum just off a tie may be rounded to the next step.
                    _ => 1.01 * step(storage),
                };
                assert!(
                    difference <= allowed,
                    "{storage}, radius {radius}: {difference:e} > {allowed:e}"
                );
            }
        }
    }
}

/// The reference has to be right on its own: a box over three texels, by hand.
/// Equal weights and equal values: plain sums of f32 are off on the same side in every step, by 2e-6 at a radius of 64.
#[test]
fn wide_sums_in_float32_are_off_by_their_last_rounding_only() {
    let gpu = open();
    for (radius, per_frame) in [(4, false), (12, false), (12, true), (64, false)] {
        let kernel = Kernel::from_weights(&vec![1.0; 2 * radius + 1]).unwrap();
        let channels: Channels = (0..texels(SIZE))
            .map(|texel| match texel % 2 {
                0 => [-0.9, 0.81, -0.729, 0.6561],
                _ => [-0.9001, 0.81018, -0.72924, 0.6564],
            })
            .map(|channels: [f64; 4]| channels.map(|channel| f64::from(channel as f32)))
            .collect();
        let found = blurred(&gpu, Storage::Float32, SIZE, &channels, &kernel, per_frame);
        let size = SIZE.map(|side| side as usize);
        let truth = reference::blur(&channels, size, &kernel);
        let error = largest_difference(&found, &truth);
        println!("radius {radius}: {error:.2e}");
        // Each pass rounds the sum of both parts, by 2^-25, and the sum of the rest by no more than that.
        assert!(
            error <= 4.0 * 2.0_f64.powi(-25),
            "radius {radius}: {error:e}"
        );
    }
}

#[test]
fn the_reference_is_a_separable_filter() {
    let kernel = Kernel::from_weights(&[1.0, 2.0, 1.0]).unwrap();
    let map: Channels = [0.0, 4.0, 8.0, 16.0, 0.0, 0.0]
        .into_iter()
        .map(|value| [value, 1.0, 0.0, -value])
        .collect();
    // Rows 0 4 8 / 16 0 0 give 1 4 7 / 12 4 0 along x, and along y (3a + b) / 4, (a + 3b) / 4.
    let expected = [3.75, 4.0, 5.25, 9.25, 4.0, 1.75];
    let output = reference::blur(&map, [3, 2], &kernel);
    for (texel, expected) in output.iter().zip(expected) {
        // Exact in binary.
        assert_eq!(*texel, [expected, 1.0, 0.0, -expected]);
    }
}

#[test]
fn a_kernel_of_a_width_is_as_wide_with_the_lookup() {
    for width in [0.55, 0.7, 0.9, 1.3, 2.0, 2.04, 5.5, 12.3, 31.9] {
        let kernel = Kernel::of_width(width, 64).unwrap();
        let deviation = f64::from(kernel.standard_deviation());
        // A texel's square has a variance of 1/12, a bilinear lookup one of 1/6 on average.
        let whole = (deviation * deviation + 1.0 / 12.0 + 1.0 / 6.0).sqrt();
        assert!((whole / width - 1.0).abs() <= 0.002, "{width}: {whole}");
        let least = Kernel::deviation_of_width(width);
        assert_eq!(f64::from(kernel.radius()), (2.0 * least).ceil().max(1.0));
        let weights = kernel.weights();
        assert!(weights.iter().rev().eq(weights), "{width}: {weights:?}");
    }
    let none = Kernel::of_width(0.3, 64).unwrap();
    assert_eq!(none.weights(), [0.0, 1.0, 0.0]);
    for (width, largest) in [
        (2.1, 4),
        (33.0, 64),
        (33.0, 200),
        (f64::NAN, 64),
        (-1.0, 64),
    ] {
        assert_eq!(Kernel::of_width(width, largest).unwrap_err().name, "width");
    }
}

#[test]
fn kernels_have_an_odd_number_of_weights_from_3_to_129() {
    for count in 0..140 {
        let kernel = Kernel::from_weights(&vec![1.0; count]);
        if count % 2 == 1 && (3..=129).contains(&count) {
            assert_eq!(kernel.unwrap().weights().len(), count);
        } else {
            assert_eq!(kernel.unwrap_err().name, "weights", "{count}");
        }
    }
}
