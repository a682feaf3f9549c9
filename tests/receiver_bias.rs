//! The receiver bias is derived, not tuned: this holds its derivation, on the exact bound in f64.
//!
//! A plane tilted against the light gives the kernel's texels depths `z0 + g x`, with x the offset under the kernel. If
//! x is distributed symmetrically with standard deviation s, the two Gauss nodes of the depths lie at `z0 - g s` and
//! `z0 + g s`, and the lower bound is exactly 0 in front of the lower one, because then no other point of the extremal
//! distribution lies in front of the fragment. So one standard deviation of bias is enough. Three things are added to
//! that: the moment bias widens the distribution by about the square root of alpha, the rounding of storage moves it,
//! and where a map is clamped at its border the kernel is no longer symmetric. The first two lower the bound or stay
//! far below the width that the moment bias gives; the third is what asks for 1.25 standard deviations.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

use moment_shadows::{DepthConversion, DepthRange, Kernel, ReceiverBias, Storage, TextureFormat};
use moment_shadows_lab::truth::exact_bound::{lower_bound, lower_bound_of_moments};
use moment_shadows_lab::truth::kernel::sample_positions;

/// What the library promises for unoccluded planes.
const LARGEST: f64 = 0.02;

/// A lookup between texels, where the bilinear weights are neither symmetric nor trivial.
const FRACTION: [f64; 2] = [0.2, 0.35];

/// Half precision, rounded to nearest: 11 significant bits, subnormals below 2^-14.
fn round_to_half(value: f64) -> f64 {
    if value == 0.0 {
        return 0.0;
    }
    let quantum = (value.abs().log2().floor().max(-14.0) - 10.0).exp2();
    (value / quantum).round_ties_even() * quantum
}

/// The optimised basis (Peters, GDC 2016), less `offset`.
fn quantize(b: [f64; 4], offset: f64) -> [f64; 4] {
    let root = 3f64.sqrt();
    [
        1.5 * b[0] - 2.0 * b[2] + 0.5 - offset,
        4.0 * b[1] - 4.0 * b[3] - offset,
        0.5 * root * b[0] - 2.0 / 9.0 * root * b[2] + 0.5 - offset,
        0.5 * b[1] + 0.5 * b[3] - offset,
    ]
}

fn dequantize(e: [f64; 4], offset: f64) -> [f64; 4] {
    let root = 3f64.sqrt();
    let (r, g) = (e[0] + offset - 0.5, e[1] + offset);
    let (b, a) = (e[2] + offset - 0.5, e[3] + offset);
    [
        -r / 3.0 + root * b,
        0.125 * g + a,
        -0.75 * r + 0.75 * root * b,
        -0.125 * g + a,
    ]
}

/// Moments as `storage` keeps them, to be averaged and rounded once more.
fn stored(storage: Storage, moments: [f64; 4]) -> [f64; 4] {
    match storage {
        Storage::Unorm16 => quantize(moments, 0.0),
        Storage::Float16 => quantize(moments, 0.5),
        _ => moments,
    }
}

fn rounded(storage: Storage, channels: [f64; 4]) -> [f64; 4] {
    channels.map(|value| match storage {
        Storage::Unorm16 => (value.clamp(0.0, 1.0) * 65535.0).round() / 65535.0,
        Storage::Float16 => round_to_half(value),
        _ => f64::from(value as f32),
    })
}

/// What a lookup gives after a resolve of four samples and a two-pass blur, each rounded to `storage`, with the moment
/// bias applied. `depth` is the moment depth at an offset in texels from the lookup.
fn looked_up(storage: Storage, kernel: &Kernel, depth: &dyn Fn(f64, f64) -> f64) -> [f64; 4] {
    let radius = f64::from(kernel.radius());
    let size = 2 * kernel.radius() as usize + 2;
    let samples = sample_positions(4).unwrap();
    let texel = |x: usize, y: usize| {
        let mut sum = [0.0; 4];
        for [sample_x, sample_y] in samples {
            let z = depth(
                x as f64 - radius + sample_x - 0.5 - FRACTION[0],
                y as f64 - radius + sample_y - 0.5 - FRACTION[1],
            );
            sum[0] += z / 4.0;
            sum[1] += z * z / 4.0;
            sum[2] += z * z * z / 4.0;
            sum[3] += z * z * z * z / 4.0;
        }
        rounded(storage, stored(storage, sum))
    };
    let blurred = |at: &dyn Fn(usize) -> [f64; 4]| {
        let mut sum = [0.0; 4];
        for (index, &weight) in kernel.weights().iter().enumerate() {
            let channels = at(index);
            for (sum, channel) in sum.iter_mut().zip(channels) {
                *sum += f64::from(weight) * channel;
            }
        }
        rounded(storage, sum)
    };
    let map: Vec<[f64; 4]> = (0..size * size)
        .map(|index| texel(index % size, index / size))
        .collect();
    let mut result = [0.0; 4];
    for (column, share_x) in [(0, 1.0 - FRACTION[0]), (1, FRACTION[0])] {
        let rows: Vec<[f64; 4]> = (0..size)
            .map(|y| blurred(&|index| map[y * size + column + index]))
            .collect();
        for (row, share_y) in [(0, 1.0 - FRACTION[1]), (1, FRACTION[1])] {
            let channels = blurred(&|index| rows[row + index]);
            for (result, channel) in result.iter_mut().zip(channels) {
                *result += share_x * share_y * channel;
            }
        }
    }
    let moments = match storage {
        Storage::Unorm16 => dequantize(result, 0.0),
        Storage::Float16 => dequantize(result, 0.5),
        _ => result,
    };
    let bias = storage.moment_bias();
    let (alpha, beta) = (f64::from(bias.alpha), f64::from(bias.second));
    let target = [0.0, beta, 0.0, beta];
    std::array::from_fn(|j| moments[j] + alpha * (target[j] - moments[j]))
}

/// Where the plane stops being seen by the kernel.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Beyond {
    /// Nowhere.
    Endless,
    /// The map ends this many texels from the lookup, and its last texel repeats.
    Border(f64),
    /// The plane ends there, and what is beyond is the far end.
    Edge(f64),
}

/// The largest lower bound over planes tilted 0 to 80 degrees, with `standard_deviations` of bias and `noise` by which
/// the fragment depth is too far.
fn worst(
    storage: Storage,
    kernel: &Kernel,
    beyond: &[Beyond],
    standard_deviations: f64,
    noise: f64,
) -> f64 {
    let mut worst = 0.0f64;
    // A texel is 1/1024 of a footprint that is half to four times as wide as the depth range.
    for footprint in [0.5, 1.0, 4.0] {
        let depth_per_texel = 2.0 * footprint / 1024.0;
        let bias = ReceiverBias::for_kernel(kernel.standard_deviation(), depth_per_texel as f32);
        for tilt in (0..=80).step_by(10) {
            let gradient = depth_per_texel * f64::from(tilt).to_radians().tan();
            let relative = standard_deviations / f64::from(ReceiverBias::STANDARD_DEVIATIONS);
            let receiver_bias =
                relative * (f64::from(bias.slope_scale) * gradient).min(f64::from(bias.maximum));
            for direction in [0.0f64, 30.0, 45.0, 180.0] {
                let along = direction.to_radians();
                let (gx, gy) = (gradient * along.cos(), gradient * along.sin());
                for z0 in [-0.8, -0.3, 0.0, 0.5, 0.9] {
                    // The plane lies in the range of depths as far as the kernel sees it.
                    let reach = f64::from(kernel.radius()) + 1.5;
                    if f64::abs(z0) + reach * (gx.abs() + gy.abs()) > 1.0 {
                        continue;
                    }
                    for &beyond in beyond {
                        let depth = |x: f64, y: f64| match beyond {
                            Beyond::Border(end) => z0 + gx * x.min(end) + gy * y,
                            Beyond::Edge(end) if x > end => 1.0,
                            _ => z0 + gx * x + gy * y,
                        };
                        let moments = looked_up(storage, kernel, &depth);
                        let bound = lower_bound_of_moments(moments, z0 - receiver_bias + noise);
                        worst = worst.max(bound);
                    }
                }
            }
        }
    }
    worst
}

#[test]
fn one_standard_deviation_suffices_for_a_symmetric_kernel() {
    // Without storage and moment bias: a Gaussian's own taps, on a plane of gradient 0.01 per texel.
    let kernel = Kernel::gaussian(4, 2.4).unwrap();
    let weights: Vec<f64> = kernel.weights().iter().copied().map(f64::from).collect();
    let depths: Vec<f64> = (-4..=4).map(|offset| 0.01 * f64::from(offset)).collect();
    let deviation = 0.01 * f64::from(kernel.standard_deviation());
    // The kernel's deviation is rounded to single precision: 1e-6 of it covers that.
    assert_eq!(
        lower_bound(&depths, &weights, -deviation * (1.0 + 1e-6)),
        0.0
    );
    // And it is necessary: without any bias a fifth of the plane's light is lost, which is the acne to be avoided.
    assert!(lower_bound(&depths, &weights, 0.0) > 0.2);
}

#[test]
fn the_truncated_gaussian_is_narrower_than_its_sigma() {
    // 2 (1 e^-1/11.52 + 4 e^-4/11.52 + 9 e^-9/11.52 + 16 e^-16/11.52) / (the sum of the weights) = 2.0463^2.
    let deviation = Kernel::gaussian(4, 2.4).unwrap().standard_deviation();
    assert!((deviation - 2.0463).abs() < 1e-4, "{deviation}");
}

#[test]
fn planes_are_lit_in_every_storage() {
    for storage in Storage::OF_FOUR_MOMENTS {
        for (radius, sigma) in [(1, 0.6), (2, 1.2), (4, 2.4), (8, 4.8)] {
            let kernel = Kernel::gaussian(radius, sigma).unwrap();
            let bias = f64::from(ReceiverBias::STANDARD_DEVIATIONS);
            let bound = worst(storage, &kernel, &[Beyond::Endless], bias, 0.0);
            assert!(bound <= LARGEST, "{storage}, radius {radius}: {bound}");
        }
    }
}

#[test]
fn planes_are_lit_at_borders_and_edges() {
    let kernel = Kernel::gaussian(4, 2.4).unwrap();
    let beyond: Vec<Beyond> = [0.0, 0.5, 1.0, 2.0, 3.0]
        .into_iter()
        .flat_map(|end| [Beyond::Border(end), Beyond::Edge(end)])
        .collect();
    for storage in Storage::OF_FOUR_MOMENTS {
        let bias = f64::from(ReceiverBias::STANDARD_DEVIATIONS);
        let bound = worst(storage, &kernel, &beyond, bias, 0.0);
        assert!(bound <= LARGEST, "{storage}: {bound}");
    }
    // Here one standard deviation is not enough: the reason for the quarter more.
    assert!(worst(Storage::Float32, &kernel, &beyond, 1.0, 0.0) > LARGEST);
}

#[test]
fn fragment_depths_may_be_off_by_their_rounding() {
    // The moment bias alone widens a single depth to a distribution, in which a fragment must lie far behind the mean
    // to be shadowed: 6e-5 with single precision, more with the others. Rounding of a 16-bit depth map, 1.5e-5, and
    // of positions in single precision is less than that, so that no constant bias is needed for the shader's bound.
    let kernel = Kernel::gaussian(4, 2.4).unwrap();
    for storage in Storage::OF_FOUR_MOMENTS {
        let bias = f64::from(ReceiverBias::STANDARD_DEVIATIONS);
        let bound = worst(storage, &kernel, &[Beyond::Endless], bias, 5e-5);
        assert!(bound <= LARGEST, "{storage}: {bound}");
    }
}

#[test]
fn the_largest_kernel_needs_no_more() {
    let kernel = Kernel::gaussian(64, 38.4).unwrap();
    let depth_per_texel = 2.0 / 1024.0;
    let bias = ReceiverBias::for_kernel(kernel.standard_deviation(), depth_per_texel as f32);
    for storage in Storage::OF_FOUR_MOMENTS {
        for tilt in [0.0f64, 20.0, 70.0] {
            let gradient = depth_per_texel * tilt.to_radians().tan();
            // The part of the plane under the kernel fills most of the range at 70 degrees.
            let moments = looked_up(storage, &kernel, &|x, _| gradient * x);
            let fragment = -f64::from(bias.slope_scale) * gradient;
            let bound = lower_bound_of_moments(moments, fragment);
            assert!(bound <= LARGEST, "{storage} at {tilt} degrees: {bound}");
        }
    }
}

/// The step of stored depth at a moment depth, as the shader unpacks it.
fn step(bias: &ReceiverBias, z: f64) -> f64 {
    let half = |bits: u32| f64::from(bits as u16 as i16) / 32767.0;
    (2.0 * (half(bias.step) + half(bias.step >> 16) * z)).powi(2)
}

#[test]
fn steps_of_stored_distances_are_shares_of_the_farthest() {
    // Numbers up to ten thousand in single precision, for a range of ten.
    let range = DepthRange {
        near: 9_990.0,
        far: 10_000.0,
    };
    let conversion = DepthConversion::linear(range).unwrap();
    let bias = ReceiverBias::NONE.for_stored_depth(TextureFormat::R32Float, &conversion);
    let expected = 2.0 / 10.0 * 10_000.0 * 2.0_f64.powi(-24);
    for z in [-1.0, 0.0, 1.0] {
        assert!((step(&bias, z) / expected - 1.0).abs() < 0.01, "{z}");
    }
    // Of 24 bits as of 16, reversed or not, for integers are as coarse at both ends.
    for (format, most) in [
        (TextureFormat::Depth16Unorm, 65535.0),
        (TextureFormat::Depth24Plus, 16_777_215.0),
        (TextureFormat::Depth24PlusStencil8, 16_777_215.0),
    ] {
        let forward = DepthConversion::orthographic();
        for conversion in [forward, forward.reversed()] {
            let bias = ReceiverBias::NONE.for_stored_depth(format, &conversion);
            assert!(
                (step(&bias, 0.3) * most / 2.0 - 1.0).abs() < 0.2,
                "{format}"
            );
        }
    }
}
