//! What a table has to be: integers of texels by exact arithmetic, and their sums one after the other.

use half::f16;
use moment_shadows::{MapEncoding, MapRegion, Storage, SummedAreaTable, Technique};

/// The integers of all texels of a map, each channel of a texel after the other. `bytes` are as the texture holds them.
///
/// Products are of 64 bits here, where the shader has several of 32. The channels of float32 moments are computed in f32
/// with fused products, as the basis is written.
#[must_use]
pub fn integers(source: &MapEncoding, table: &SummedAreaTable, bytes: &[u8]) -> Vec<u32> {
    let channels = source.technique().row().channels as usize;
    let (size, read): (usize, fn(&[u8]) -> f32) = match source.storage() {
        Storage::Float16 => (2, |pair| f16::from_le_bytes([pair[0], pair[1]]).to_f32()),
        Storage::Float32 => (4, |four| {
            f32::from_le_bytes([four[0], four[1], four[2], four[3]])
        }),
        _ => {
            let pairs = bytes.chunks_exact(2);
            let integer = |pair: &[u8]| u32::from(u16::from_le_bytes([pair[0], pair[1]]));
            return pairs.map(integer).collect();
        }
    };
    let texels = bytes.chunks_exact(size * channels);
    texels
        .flat_map(|bytes| {
            let texel: Vec<f32> = bytes.chunks_exact(size).map(read).collect();
            let values = match source.storage() {
                _ if texel.iter().any(|channel| !channel.is_finite()) => far(source.technique()),
                Storage::Float16 => {
                    std::array::from_fn(|channel| texel.get(channel).map_or(0.0, |it| it + 0.5))
                }
                _ => encoded(source.technique(), &texel),
            };
            (0..channels).map(move |channel| fixed_point(values[channel], table.unit()))
        })
        .collect()
}

/// A channel in units, to the nearest.
#[must_use]
pub fn fixed_point(channel: f32, unit: u32) -> u32 {
    // To 31 bits, as far as any float of at least 2^-8 goes.
    let fraction = (f64::from(channel.clamp(0.0, 1.0)) * 2.0_f64.powi(31)).round_ties_even() as u64;
    ((fraction * u64::from(unit) + (1 << 30)) >> 31) as u32
}

/// The optimised basis of float32 moments, as `four_moments_quantize` and `two_moments_to_texel` have it.
fn encoded(technique: &Technique, texel: &[f32]) -> [f32; 4] {
    if *technique == Technique::Vsm {
        let [x, y] = [texel[0], texel[1]].map(|moment| moment.clamp(-1.0, 1.0));
        return [0.5_f32.mul_add(x, 0.5), 1.0 - y, 0.0, 0.0];
    }
    let odd = |moment: f32| moment.clamp(-1.0, 1.0);
    let even = |moment: f32| moment.clamp(0.0, 1.0);
    optimised([odd(texel[0]), even(texel[1]), odd(texel[2]), even(texel[3])])
}

/// `four_moments_quantize` with fused products.
#[must_use]
pub fn optimised([x, y, z, w]: [f32; 4]) -> [f32; 4] {
    let root = 3.0_f32.sqrt();
    [
        1.5_f32.mul_add(x, (-2.0_f32).mul_add(z, 0.5)),
        4.0 * (y - w),
        (0.5 * root).mul_add(x, (-2.0 / 9.0 * root).mul_add(z, 0.5)),
        0.5 * (y + w),
    ]
}

/// The channels of a texel without a caster.
fn far(technique: &Technique) -> [f32; 4] {
    encoded(technique, &[1.0; 4])
}

/// The table of one layer: in each texel of a region the wrapping sum of its texels up to it; elsewhere 0.
#[must_use]
pub fn table(integers: &[u32], channels: usize, width: usize, regions: &[MapRegion]) -> Vec<u32> {
    let mut table = vec![0_u32; integers.len()];
    for region in regions {
        let [left, top] = region.origin.map(|side| side as usize);
        let [columns, rows] = region.extent.map(|side| side as usize);
        for row in top..top + rows {
            let mut sums = vec![0_u32; channels];
            for column in left..left + columns {
                for (channel, sum) in sums.iter_mut().enumerate() {
                    let index = (row * width + column) * channels + channel;
                    *sum = sum.wrapping_add(integers[index]);
                    let above = if row > top {
                        table[index - width * channels]
                    } else {
                        0
                    };
                    table[index] = above.wrapping_add(*sum);
                }
            }
        }
    }
    table
}

/// The integers that a layer's table with one region is the sum of.
#[must_use]
pub fn differences(table: &[u32], channels: usize, width: usize) -> Vec<u32> {
    let row = width * channels;
    let at = |index: usize, back: usize, inside: bool| if inside { table[index - back] } else { 0 };
    (0..table.len())
        .map(|index| {
            let (left, above) = (index % row >= channels, index >= row);
            table[index]
                .wrapping_sub(at(index, channels, left))
                .wrapping_sub(at(index, row, above))
                .wrapping_add(at(index, row + channels, left && above))
        })
        .collect()
}
