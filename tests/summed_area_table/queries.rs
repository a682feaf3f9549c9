//! Means of rectangles on the device, against sums over the texels themselves.

use moment_shadows::{MapRegion, Storage, Technique};
use moment_shadows_graph::record::Layers;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::summed_area::{Means, Query, SummedMap};
use rand::RngExt as _;

use crate::setup::{both, encoding, gpu, map, noise, random};

/// No multiples of anything; regions below are parts of it.
const SIZE: [u32; 2] = [701, 523];

/// The largest kernel of the tables.
const KERNEL: [u32; 2] = [160, 96];

/// Sums of the 16-bit integers of a map's rectangles from (0, 0) on, in 64 bits.
struct Sums {
    width: usize,
    sums: Vec<[u64; 4]>,
}

impl Sums {
    fn of(bytes: &[u8], size: [u32; 2]) -> Self {
        let [width, height] = size.map(|side| side as usize);
        // A row and a column of zeros come first.
        let mut sums = vec![[0; 4]; (width + 1) * (height + 1)];
        for y in 0..height {
            let mut row = [0; 4];
            for x in 0..width {
                for channel in 0..4 {
                    let at = 2 * (4 * (y * width + x) + channel);
                    row[channel] += u64::from(u16::from_le_bytes([bytes[at], bytes[at + 1]]));
                    sums[(y + 1) * (width + 1) + x + 1][channel] =
                        sums[y * (width + 1) + x + 1][channel] + row[channel];
                }
            }
        }
        Self { width, sums }
    }

    /// From corner to corner, in texels.
    fn whole(&self, low: [usize; 2], high: [usize; 2]) -> [f64; 4] {
        let at = |x: usize, y: usize| self.sums[y * (self.width + 1) + x];
        let [a, b] = [at(low[0], low[1]), at(high[0], low[1])];
        let [c, d] = [at(low[0], high[1]), at(high[0], high[1])];
        core::array::from_fn(|channel| {
            // Differences of exact sums, ordered so that none is negative.
            (d[channel] - c[channel] - (b[channel] - a[channel])) as f64
        })
    }

    /// The mean over a rectangle: every texel with the part that is covered, summed up in f64 strip by strip.
    fn mean(&self, low: [f64; 2], high: [f64; 2]) -> [f64; 4] {
        let strips = |axis: usize| {
            let (first, end) = (low[axis].floor() as usize, high[axis].ceil() as usize);
            let mut strips = Vec::new();
            let (inner_first, inner_end) = (low[axis].ceil() as usize, high[axis].floor() as usize);
            if inner_first > inner_end {
                strips.push((first, end, high[axis] - low[axis]));
                return strips;
            }
            strips.push((first, inner_first, inner_first as f64 - low[axis]));
            strips.push((inner_first, inner_end, 1.0));
            strips.push((inner_end, end, high[axis] - inner_end as f64));
            strips.retain(|strip| strip.0 < strip.1);
            strips
        };
        let mut sum = [0.0; 4];
        for (left, right, across) in strips(0) {
            for (top, bottom, down) in strips(1) {
                let part = self.whole([left, top], [right, bottom]);
                for channel in 0..4 {
                    sum[channel] += across * down * part[channel];
                }
            }
        }
        let area = (high[0] - low[0]) * (high[1] - low[1]);
        sum.map(|channel| channel / area / 65535.0)
    }
}

fn table(gpu: &Gpu, bytes: &[u8], regions: &[MapRegion]) -> SummedMap {
    let desc = moment_shadows_graph::TextureDesc {
        regions: regions.len() as u32,
        ..map(&encoding(Technique::Hamburger4, Storage::Unorm16), SIZE, 1)
    };
    let [_, software] = both(gpu);
    let summed = SummedMap::new(gpu, &software, &desc, bytes, KERNEL).unwrap();
    summed.set_regions(gpu, 0, regions).unwrap();
    summed.run(gpu, Layers::All).unwrap();
    summed
}

fn bytes() -> Vec<u8> {
    noise(
        &map(&encoding(Technique::Hamburger4, Storage::Unorm16), SIZE, 1),
        7,
    )
}

/// A region inside, whose sums do not begin at the map's corner, and one at its end.
const REGIONS: [MapRegion; 3] = [
    MapRegion::new([0, 0], [301, 523]),
    MapRegion::new([301, 13], [350, 500]),
    MapRegion::new([651, 13], [50, 510]),
];

fn query(region: MapRegion, centre: [f32; 2], half_extent: [f32; 2]) -> Query {
    Query {
        region,
        centre,
        half_extent,
        largest: KERNEL.map(|side| side as f32),
        interpolated: 1,
        unit: 65535.0,
    }
}

/// A million rectangles, some at whole texels, some narrow, some beyond the edges or too large.
#[test]
fn means_are_those_of_the_texels() {
    let gpu = gpu();
    let bytes = bytes();
    let sums = Sums::of(&bytes, SIZE);
    let summed = table(&gpu, &bytes, &REGIONS);
    let means = Means::new(&gpu, &summed).unwrap();
    let mut random = random(8);
    let queries: Vec<Query> = (0..1_000_000)
        .map(|index: u32| {
            let region = REGIONS[index as usize % 3];
            let place = |axis: usize, random: &mut rand_chacha::ChaCha8Rng| {
                let first = region.origin[axis] as f32;
                let place: f32 =
                    random.random_range(-9.0..9.0 + region.extent[axis] as f32) + first;
                if index.is_multiple_of(5) {
                    place.round()
                } else {
                    place
                }
            };
            let centre = [place(0, &mut random), place(1, &mut random)];
            let half_extent = [0, 1].map(|_| {
                let reach: f32 = 90.0 * random.random_range(0.0_f32..1.0).powi(2);
                if index.is_multiple_of(7) {
                    (2.0 * reach).round() * 0.5
                } else {
                    reach
                }
            });
            Query {
                interpolated: u32::from(index % 4 != 3),
                ..query(region, centre, half_extent)
            }
        })
        .collect();
    let answers = means.run(&queries).unwrap();
    let mut worst = [0.0_f64; 2];
    for (query, answer) in queries.iter().zip(&answers) {
        let [mut low, mut high] = [answer.low, answer.high].map(|corner| corner.map(f64::from));
        for axis in 0..2 {
            let first = f64::from(query.region.origin[axis]);
            let end = first + f64::from(query.region.extent[axis]);
            let width = high[axis] - low[axis];
            // f32 rounds an edge to 2^-15 of a texel beyond texel 256.
            assert!(
                low[axis] >= first && high[axis] <= end,
                "{query:?} {answer:?}"
            );
            assert!(width > 0.9998, "{query:?} {answer:?}");
            assert!(
                width < f64::from(KERNEL[axis]) + 2e-4,
                "{query:?} {answer:?}"
            );
        }
        if query.interpolated == 0 {
            for axis in 0..2 {
                let end = f64::from(query.region.origin[axis] + query.region.extent[axis]);
                low[axis] = low[axis].round_ties_even().min(end - 1.0);
                high[axis] = high[axis].round_ties_even().clamp(low[axis] + 1.0, end);
            }
        }
        let expected = sums.mean(low, high);
        for channel in 0..4 {
            let error = (f64::from(answer.mean[channel]) - expected[channel]).abs();
            worst[query.interpolated as usize] = worst[query.interpolated as usize].max(error);
            assert!(
                error <= 2.0_f64.powi(-20),
                "{query:?} {answer:?} {expected:?}"
            );
        }
    }
    println!(
        "largest error: plain {:.2e}, interpolated {:.2e}",
        worst[0], worst[1]
    );
}

/// Rectangles at whole texels, as both queries answer them: exact sums, to the rounding of one division.
#[test]
fn both_queries_agree_at_whole_texels() {
    let gpu = gpu();
    let bytes = bytes();
    let sums = Sums::of(&bytes, SIZE);
    let summed = table(&gpu, &bytes, &REGIONS[1..2]);
    let means = Means::new(&gpu, &summed).unwrap();
    let [left, top] = REGIONS[1].origin;
    // From the region's corner and across to its last texel, too.
    let places = [
        ([left, top], [1, 1]),
        ([left, top], [160, 96]),
        ([left + 349, top + 499], [1, 1]),
        ([left + 190, top + 404], [160, 96]),
        ([left + 64, top], [3, 90]),
        ([left, top + 70], [90, 3]),
    ];
    for (first, extent) in places {
        let half_extent = extent.map(|side| 0.5 * side as f32);
        let centre = [0, 1].map(|axis| first[axis] as f32 + half_extent[axis]);
        let end = [0, 1].map(|axis| (first[axis] + extent[axis]) as usize);
        let expected = sums.whole(first.map(|place| place as usize), end);
        for interpolated in [0, 1] {
            let query = Query {
                interpolated,
                ..query(REGIONS[1], centre, half_extent)
            };
            let answer = means.run(&[query]).unwrap()[0];
            for channel in 0..4 {
                let area = f64::from(extent[0] * extent[1]);
                let expected = expected[channel] / area / 65535.0;
                let error = (f64::from(answer.mean[channel]) - expected).abs();
                assert!(
                    error < 4.0 * 2.0_f64.powi(-24),
                    "{first:?} {extent:?} {error:e}"
                );
            }
        }
    }
}

/// NaN or infinite numbers, and rectangles that are nowhere: a mean of texels of the region all the same.
#[test]
fn hostile_rectangles_stay_in_their_region() {
    let gpu = gpu();
    let bytes = bytes();
    // Everything outside the region is as bright as can be; inside are values up to one half.
    let region = REGIONS[1];
    let inside = |axis: usize, place: usize| {
        (region.origin[axis] as usize..(region.origin[axis] + region.extent[axis]) as usize)
            .contains(&place)
    };
    let bytes: Vec<u8> = bytes
        .chunks_exact(2)
        .enumerate()
        .flat_map(|(index, pair)| {
            let texel = index / 4;
            let (x, y) = (texel % SIZE[0] as usize, texel / SIZE[0] as usize);
            let value = u16::from_le_bytes([pair[0], pair[1]]);
            let value = if inside(0, x) && inside(1, y) {
                value / 2
            } else {
                u16::MAX
            };
            value.to_le_bytes()
        })
        .collect();
    let summed = table(&gpu, &bytes, &[region]);
    let means = Means::new(&gpu, &summed).unwrap();
    let hostile = [
        f32::NAN,
        -f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::MAX,
        f32::MIN,
        f32::MIN_POSITIVE,
        -0.0,
        0.0,
        -1e9,
        1e9,
        1e-30,
        301.0,
        651.0,
        650.999_94,
        512.999_94,
    ];
    let mut queries = Vec::new();
    for x in hostile {
        for y in hostile {
            for reach in hostile {
                for other in [reach, 2.0] {
                    for interpolated in [0, 1] {
                        for largest in [KERNEL.map(|side| side as f32), [f32::MAX, 0.0]] {
                            queries.push(Query {
                                interpolated,
                                largest,
                                ..query(region, [x, y], [reach, other])
                            });
                        }
                    }
                }
            }
        }
    }
    for (query, answer) in queries.iter().zip(means.run(&queries).unwrap()) {
        // With rounding of 2^-20. With a larger kernel than the table's, sums wrap around.
        let right = query.largest[0] == f32::MAX
            || answer
                .mean
                .iter()
                .all(|&mean| (0.0..=0.500_001).contains(&mean));
        let is_number = answer.mean.iter().all(|mean| (0.0..=1.0).contains(mean));
        assert!(right && is_number, "{query:?} {answer:?}");
        for axis in 0..2 {
            let first = region.origin[axis] as f32;
            let end = first + region.extent[axis] as f32;
            let width = answer.high[axis] - answer.low[axis];
            assert!(
                answer.low[axis] >= first && answer.high[axis] <= end,
                "{query:?} {answer:?}"
            );
            assert!(width > 0.9998, "{query:?} {answer:?}");
        }
    }
}

/// A map of ones has the mean 1 wherever one looks, though its sums wrap around.
#[test]
fn a_map_of_ones_has_the_mean_1() {
    let gpu = gpu();
    let bytes = vec![255; 8 * (SIZE[0] * SIZE[1]) as usize];
    let summed = table(&gpu, &bytes, &REGIONS);
    let means = Means::new(&gpu, &summed).unwrap();
    let mut random = random(9);
    let queries: Vec<Query> = (0..10_000)
        .map(|index: u32| {
            let place = [
                random.random_range(0.0..701.0),
                random.random_range(0.0..523.0),
            ];
            let extent = [
                random.random_range(0.0..90.0),
                random.random_range(0.0..50.0),
            ];
            query(REGIONS[index as usize % 3], place, extent)
        })
        .collect();
    for (query, answer) in queries.iter().zip(means.run(&queries).unwrap()) {
        // Five roundings.
        let error = answer
            .mean
            .iter()
            .fold(0.0_f32, |worst, mean| worst.max(1.0 - mean));
        assert!(
            (0.0..=5.0 / 16_777_216.0).contains(&error),
            "{query:?} {answer:?}"
        );
    }
}
