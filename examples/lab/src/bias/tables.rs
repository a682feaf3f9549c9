//! The smallest safe moment bias of summed-area tables: patches whose rectangles are summed up in integers, looked up and
//! decoded in f32 as the WGSL modules do it.

use core::fmt;

use moment_shadows::{Storage, SummedAreaTable, ValueError};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;
use serde::Serialize;

use super::definite::{Condition, Repair};
use super::form::rounded;
use super::patch::{self, Patch, SIDE};
use super::search::{Quantiles, quantiles};
use crate::summed_area::reference::{fixed_point, optimised};

/// How often each texel of a patch is repeated along each axis: kernels of 9, 27 and 63 texels.
const REPEATS: [usize; 3] = [1, 3, 7];

/// Patches per stream of random numbers.
const PER_STREAM: usize = 1024;

/// What one table needs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TableBiasRow {
    /// The map's storage.
    pub source: Storage,
    /// Texels along each side of the largest kernel.
    pub side: u32,
    /// The alphas from which on moments on the real line are possible.
    pub line: Quantiles,
    /// The alphas from which on moments on the depth interval are possible.
    pub interval: Quantiles,
    /// What the library applies, for both.
    pub library: [f64; 2],
    /// The most that the variance of two moments falls below the true one.
    pub variance_deficit: f64,
    /// The library's smallest variance.
    pub smallest_variance: f64,
}

/// What all tables need.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TableBiases {
    /// Patches per row.
    pub samples: usize,
    /// Seed of the random numbers.
    pub seed: u64,
    /// A row per storage and kernel.
    pub rows: Vec<TableBiasRow>,
}

/// Searches tables of every storage with kernels of 9, 27 and 63 texels. `step` is called now and then.
pub fn search_tables(
    samples: usize,
    seed: u64,
    step: impl Fn() + Sync,
) -> Result<TableBiases, ValueError> {
    let mut rows = Vec::new();
    for source in Storage::OF_FOUR_MOMENTS {
        for repeats in REPEATS {
            let side = (SIDE * repeats) as u32;
            let table = SummedAreaTable::new(source, [side; 2])?;
            rows.push(measure(&table, repeats, samples.max(1), seed, &step));
        }
    }
    Ok(TableBiases {
        samples: samples.max(1),
        seed,
        rows,
    })
}

/// How often [`search_tables`] calls its `step`.
#[must_use]
pub fn table_steps(samples: usize) -> usize {
    Storage::OF_FOUR_MOMENTS.len() * REPEATS.len() * samples.max(1).div_ceil(PER_STREAM)
}

fn measure(
    table: &SummedAreaTable,
    repeats: usize,
    samples: usize,
    seed: u64,
    step: &(impl Fn() + Sync),
) -> TableBiasRow {
    let biases = [table.moment_bias(), table.hausdorff_moment_bias()];
    let [line, interval] = [Condition::Line, Condition::Interval];
    let repairs = [(line, biases[0]), (interval, biases[1])].map(|(condition, bias)| {
        let target = [0.0, f64::from(bias.second), 0.0, f64::from(bias.fourth)];
        Repair::new([-1.0, 1.0], condition, target)
    });
    let found: Vec<[f64; 3]> = (0..samples.div_ceil(PER_STREAM))
        .into_par_iter()
        .flat_map_iter(|stream| {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            random.set_stream(stream as u64);
            let count = PER_STREAM.min(samples - stream * PER_STREAM);
            let found: Vec<[f64; 3]> = (0..count)
                .map(|_| {
                    let patch = patch::patch(&mut random);
                    let axes = [0, 1].map(|_| Axis::random(&mut random, repeats));
                    let moments = moments(&mean(&texels(&patch, table, four), &axes, table));
                    let [x, y] = variance(&mean(&texels(&patch, table, two), &axes, table));
                    let deficit = true_variance(&patch, &axes) - (y - x * x);
                    let [line, interval] =
                        [0, 1].map(|index| repairs[index].smallest_alpha(moments));
                    [line, interval, deficit]
                })
                .collect();
            step();
            found
        })
        .collect();
    let of = |index: usize| quantiles(found.iter().map(|found| found[index]).collect());
    TableBiasRow {
        source: table.source(),
        side: table.largest_kernel()[0],
        line: of(0),
        interval: of(1),
        library: biases.map(|bias| f64::from(bias.alpha)),
        variance_deficit: of(2).all,
        smallest_variance: f64::from(table.smallest_variance()),
    }
}

/// A rectangle's extent along an axis: how many texels of each repeated one lie in each strip, and the strips' weights.
struct Axis {
    counts: [[u64; SIDE]; 3],
    weights: [f32; 3],
    extent: f32,
}

impl Axis {
    fn random(random: &mut ChaCha8Rng, repeats: usize) -> Self {
        let side = (SIDE * repeats) as f32;
        // Most rectangles are nearly as large as can be.
        let extent = 1.0 + (side - 1.0) * random.random_range(0.0_f32..=1.0).sqrt();
        let low = random.random_range(0.0..=1.0) * (side - extent);
        let high = (low + extent).min(side);
        let first = low.floor();
        let last = high.floor().max(first + 1.0);
        let [low_part, high_part] = [first + 1.0 - low, (high - last).clamp(0.0, 1.0)];
        let mut counts = [[0; SIDE]; 3];
        let [first, last] = [first as usize, last as usize];
        for (strip, texels) in [first..first + 1, first + 1..last, last..last + 1]
            .into_iter()
            .enumerate()
        {
            for texel in texels.filter(|&texel| texel < SIDE * repeats) {
                counts[strip][texel / repeats] += 1;
            }
        }
        Self {
            counts,
            weights: [low_part, 1.0, high_part],
            extent: (last - first) as f32 - 1.0 + low_part + high_part,
        }
    }
}

/// The encoded channels of a depth as its map holds them, in f32.
fn four(depth: f32, source: Storage) -> [f32; 4] {
    let square = depth * depth;
    let raw = [depth, square, depth * square, square * square];
    stored(optimised(raw), source)
}

fn two(depth: f32, source: Storage) -> [f32; 4] {
    let channels = [0.5_f32.mul_add(depth, 0.5), 1.0 - depth * depth, 0.0, 0.0];
    stored(channels, source)
}

/// Float32 maps hold raw moments, from which the table's channels are computed: no rounding besides that of f32.
fn stored(channels: [f32; 4], source: Storage) -> [f32; 4] {
    channels.map(|channel| match source {
        Storage::Float16 => rounded(source, channel.clamp(0.0, 1.0) - 0.5) + 0.5,
        _ => rounded(source, channel),
    })
}

/// The integers of a patch.
fn texels(
    patch: &Patch,
    table: &SummedAreaTable,
    channels: fn(f32, Storage) -> [f32; 4],
) -> Vec<[u32; 4]> {
    patch
        .iter()
        .map(|&depth| {
            channels(depth, table.source()).map(|channel| fixed_point(channel, table.unit()))
        })
        .collect()
}

/// The mean as `summed_area_table_mean_interpolated` computes it: nine exact sums, weighed in f32.
fn mean(texels: &[[u32; 4]], [across, down]: &[Axis; 2], table: &SummedAreaTable) -> [f32; 4] {
    let scale = 1.0 / (table.unit() as f32 * across.extent * down.extent);
    core::array::from_fn(|channel| {
        let rectangle = |column: usize, row: usize| {
            let mut sum = 0;
            for (texel, integers) in texels.iter().enumerate() {
                let count = across.counts[column][texel % SIDE] * down.counts[row][texel / SIDE];
                sum += count * u64::from(integers[channel]);
            }
            sum as f32
        };
        let rows: [f32; 3] = core::array::from_fn(|row| {
            let outer = across.weights[0].mul_add(rectangle(0, row), rectangle(1, row));
            across.weights[2].mul_add(rectangle(2, row), outer)
        });
        let upper = down.weights[0].mul_add(rows[0], rows[1]);
        (down.weights[2].mul_add(rows[2], upper) * scale).clamp(0.0, 1.0)
    })
}

/// `four_moments_dequantize` in f32.
fn moments(channels: &[f32; 4]) -> [f64; 4] {
    let root = 3.0_f32.sqrt();
    let [x, z] = [channels[0] - 0.5, channels[2] - 0.5];
    [
        (-1.0_f32 / 3.0).mul_add(x, root * z),
        0.125_f32.mul_add(channels[1], channels[3]),
        0.75 * root.mul_add(z, -x),
        (-0.125_f32).mul_add(channels[1], channels[3]),
    ]
    .map(f64::from)
}

/// The two moments of `two_moments_from_texel` for unorm16.
fn variance(channels: &[f32; 4]) -> [f64; 2] {
    [2.0_f32.mul_add(channels[0], -1.0), 1.0 - channels[1]].map(f64::from)
}

/// The variance of the patch's depths over the rectangle.
fn true_variance(patch: &Patch, [across, down]: &[Axis; 2]) -> f64 {
    let part = |axis: &Axis, texel: usize| -> f64 {
        (0..3)
            .map(|strip| f64::from(axis.weights[strip]) * axis.counts[strip][texel] as f64)
            .sum()
    };
    let mut sums = [0.0; 3];
    for (texel, &depth) in patch.iter().enumerate() {
        let weight = part(across, texel % SIDE) * part(down, texel / SIDE);
        for (power, sum) in sums.iter_mut().enumerate() {
            *sum += weight * f64::from(depth).powi(power as i32);
        }
    }
    sums[2] / sums[0] - (sums[1] / sums[0]).powi(2)
}

impl fmt::Display for TableBiases {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "Smallest moment bias alpha for summed-area tables, and how far variance falls short: {} patches, seed {}\n",
            self.samples, self.seed
        )?;
        writeln!(
            f,
            "| source | largest kernel | Hamburger 99.999 % | 100 % | library | Hausdorff 99.999 % | 100 % | library | variance short \
             by | library |"
        )?;
        writeln!(f, "|---|---|---|---|---|---|---|---|---|---|")?;
        for row in &self.rows {
            writeln!(
                f,
                "| {} | {1}x{1} | {2:.2e} | {3:.2e} | {4:.2e} | {5:.2e} | {6:.2e} | {7:.2e} | {8:.2e} | {9:.2e} |",
                row.source,
                row.side,
                row.line.most,
                row.line.all,
                row.library[0],
                row.interval.most,
                row.interval.all,
                row.library[1],
                row.variance_deficit,
                row.smallest_variance
            )?;
        }
        Ok(())
    }
}
