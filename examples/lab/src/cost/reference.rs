//! What resolve and blur have to give, in double precision, and what rounding explains of a difference.

use moment_shadows::{DepthConversion, Kernel, Storage};
use rayon::prelude::*;

use super::harness::Difference;
use super::texels::{Channels, step};
use crate::host::DepthSamples;

/// A separable filter along x and y; beyond the border the last texel repeats. Nothing is rounded in between.
#[must_use]
pub fn blur(map: &[[f64; 4]], [width, height]: [usize; 2], kernel: &Kernel) -> Channels {
    let along_x = transposed(&blur_rows(map, width, kernel), width);
    transposed(&blur_rows(&along_x, height, kernel), height)
}

/// The largest error of a blur in two passes, each rounded to the storage, on channels of at most 1.
#[must_use]
pub fn blur_tolerance(storage: Storage, kernel: &Kernel) -> f64 {
    tolerance(storage, 2, kernel.weights().len())
}

/// The next coarser mip level: every texel is the mean over the part of the finer level that it covers.
#[must_use]
pub fn downsample(finer: &[[f64; 4]], from: [usize; 2], to: [usize; 2]) -> Channels {
    let narrow = transposed(&shrunk_rows(finer, from[0], to[0]), to[0]);
    transposed(&shrunk_rows(&narrow, from[1], to[1]), to[1])
}

/// The largest error of one such step.
#[must_use]
pub fn downsample_tolerance(storage: Storage) -> f64 {
    // Nine products, and weights that divisions rounded.
    tolerance(storage, 1, 32)
}

/// The channels of a resolve: the mean of the moments of every texel's samples.
#[must_use]
pub fn resolve(depth: &DepthSamples, conversion: &DepthConversion, storage: Storage) -> Channels {
    depth
        .values
        .par_chunks(depth.samples.max(1) as usize)
        .map(|samples| {
            let mut sum = [0.0; 4];
            for &stored in samples {
                let z = moment_depth(f64::from(stored), conversion);
                let mut power = 1.0;
                for moment in &mut sum {
                    power *= z;
                    *moment += power;
                }
            }
            channels(sum.map(|moment| moment / samples.len() as f64), storage)
        })
        .collect()
}

/// The largest error of a resolve of texels with this many samples.
#[must_use]
pub fn resolve_tolerance(storage: Storage, samples: u32) -> f64 {
    // The conversion, four powers and the basis take fewer than 16 operations on numbers of at most 4.
    tolerance(storage, 1, samples as usize + 32)
}

/// The largest error of a blur that resolves. Where texels are rounded inwards, rows have been packed: their depths are off by up to 2 / 65535, and
/// channels of a depth change by up to 8 times as much; the fourth moment by what half a step does to a root below 0.71, which is four times in a
/// channel. Moments may then be moved by less than four times the bias, which a channel has at most once, and be rounded by a step.
#[must_use]
pub fn resolved_blur_tolerance(storage: Storage, kernel: &Kernel, samples: u32) -> f64 {
    let inwards = match storage {
        Storage::Unorm16 | Storage::Float16 => {
            let packed = 8.0 * 2.0 / 65535.0 + 4.0 * 4.0 * 0.71_f64.powi(3) * 0.5 / 65535.0;
            packed + 4.0 * f64::from(storage.moment_bias_rounded_inwards().alpha)
        }
        _ => 0.0,
    };
    let operations = kernel.weights().len() + samples as usize + 32;
    tolerance(storage, 2, operations) + inwards
}

/// How far channels are from those of the reference.
#[must_use]
pub fn difference(output: &[[f64; 4]], reference: &[[f64; 4]], tolerance: f64) -> Difference {
    let [output, reference] =
        [output, reference].map(|texels| texels.as_flattened().iter().copied());
    Difference::of(output, reference, tolerance)
}

/// Storage of 16 bits rounds once per stage, and single-precision sums hardly matter beside that; in single precision
/// every operation rounds.
fn tolerance(storage: Storage, roundings: u32, operations: usize) -> f64 {
    match storage {
        Storage::Float32 => step(storage) * operations as f64,
        _ => step(storage) * (0.5 * f64::from(roundings) + 0.1),
    }
}

fn blur_rows(map: &[[f64; 4]], width: usize, kernel: &Kernel) -> Channels {
    let radius = kernel.radius() as usize;
    map.par_chunks(width)
        .flat_map_iter(|row| {
            (0..row.len()).map(move |x| {
                let mut sum = [0.0; 4];
                for (tap, &weight) in kernel.weights().iter().enumerate() {
                    let texel = row[(x + tap).saturating_sub(radius).min(row.len() - 1)];
                    for channel in 0..4 {
                        sum[channel] += f64::from(weight) * texel[channel];
                    }
                }
                sum
            })
        })
        .collect()
}

/// Rows of `to` texels instead of `from`.
fn shrunk_rows(map: &[[f64; 4]], from: usize, to: usize) -> Channels {
    let width = from as f64 / to as f64;
    map.par_chunks(from)
        .flat_map_iter(|row| {
            (0..to).map(move |x| {
                let (start, end) = (x as f64 * width, (x + 1) as f64 * width);
                let mut sum = [0.0; 4];
                for (index, texel) in row.iter().enumerate().skip(start as usize) {
                    let begin = index as f64;
                    let covered = end.min(begin + 1.0) - start.max(begin);
                    if covered <= 0.0 {
                        break;
                    }
                    for channel in 0..4 {
                        sum[channel] += covered / width * texel[channel];
                    }
                }
                sum
            })
        })
        .collect()
}

/// Columns as rows.
fn transposed(map: &[[f64; 4]], width: usize) -> Channels {
    (0..width)
        .flat_map(|x| map.iter().skip(x).step_by(width).copied())
        .collect()
}

/// Converts a stored depth as the WGSL module `depth` does.
fn moment_depth(stored: f64, conversion: &DepthConversion) -> f64 {
    let scaled =
        (stored * f64::from(conversion.scale) + f64::from(conversion.offset)).clamp(0.0, 1.0);
    let mix = |ends: [f32; 2]| {
        let [start, end] = ends.map(f64::from);
        start + (end - start) * scaled
    };
    (mix(conversion.numerator) / mix(conversion.denominator)).clamp(-1.0, 1.0)
}

/// The channels as the WGSL module `four_moments` stores them: the optimised basis (JCGT 6(1) 2017, section 3), centred for
/// float16.
pub(super) fn channels(b: [f64; 4], storage: Storage) -> [f64; 4] {
    if storage == Storage::Float32 {
        return b;
    }
    let root = 3.0_f64.sqrt();
    let centre = if storage == Storage::Float16 {
        0.5
    } else {
        0.0
    };
    [
        1.5 * b[0] - 2.0 * b[2] + 0.5,
        4.0 * (b[1] - b[3]),
        root * (0.5 * b[0] - 2.0 / 9.0 * b[2]) + 0.5,
        0.5 * (b[1] + b[3]),
    ]
    .map(|channel| channel.clamp(0.0, 1.0) - centre)
}
