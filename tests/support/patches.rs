//! Random 9x9 patches of depth, resolved and blurred in two passes with rounding to a storage after every stage.

use half::f16;
use moment_shadows::Storage;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Texels on a side.
pub(crate) const SIDE: usize = 9;

/// Moment depths of a patch.
pub(crate) type Patch = [[f64; SIDE]; SIDE];

/// Moment depths of a random patch: steps, planes, noise, and depths clamped to the ends.
pub(crate) fn patch(random: &mut ChaCha8Rng) -> Patch {
    let surfaces: Vec<[f64; 3]> = (0..random.random_range(1..=4))
        .map(|_| {
            let flat: bool = random.random();
            let gradient = 10.0_f64.powf(random.random_range(-6.0..-0.7));
            let [across, down] = if flat {
                [0.0; 2]
            } else {
                [
                    random.random_range(-1.0..1.0),
                    random.random_range(-1.0..1.0),
                ]
            };
            // Beyond the ends, so that many are clamped.
            let depth = random.random_range(-1.3..1.3);
            [depth, gradient * across, gradient * down]
        })
        .collect();
    // A near layer behind every edge.
    let gap = 10.0_f64.powf(random.random_range(-7.0..-1.0));
    core::array::from_fn(|row| {
        core::array::from_fn(|column| {
            let [depth, across, down] = surfaces[random.random_range(0..surfaces.len())];
            let step = if random.random_range(0..3) == 0 {
                gap
            } else {
                0.0
            };
            (depth + across * column as f64 + down * row as f64 + step).clamp(-1.0, 1.0)
        })
    })
}

/// The channels of the patch's middle texel: every depth encoded, filtered in two passes, rounded after each of three stages.
pub(crate) fn filtered(
    depths: &Patch,
    storage: Storage,
    encoded: impl Fn(f64) -> [f32; 4],
) -> [f32; 4] {
    let weights = weights();
    let sum = |texels: [[f32; 4]; SIDE]| -> [f32; 4] {
        core::array::from_fn(|channel| {
            let mut sum = 0.0_f32;
            for (weight, texel) in weights.iter().zip(&texels) {
                sum += weight * texel[channel];
            }
            rounded(sum, storage)
        })
    };
    let rows =
        depths.map(|row| sum(row.map(|depth| encoded(depth).map(|value| rounded(value, storage)))));
    sum(rows)
}

/// The 9 weights of a Gaussian with a standard deviation of 2.4 texels; their f32 sum is 1.
pub(crate) fn weights() -> [f32; SIDE] {
    let plain: [f64; SIDE] =
        core::array::from_fn(|tap| (-0.5 * ((tap as f64 - 4.0) / 2.4).powi(2)).exp());
    let sum: f64 = plain.iter().sum();
    let mut weights = plain.map(|weight| (weight / sum) as f32);
    // The residue goes to the middle.
    weights[SIDE / 2] += 1.0 - weights.iter().sum::<f32>();
    weights
}

fn rounded(value: f32, storage: Storage) -> f32 {
    match storage {
        Storage::Unorm10 => (value.clamp(0.0, 1.0) * 1023.0).round() / 1023.0,
        Storage::Unorm16 => (value.clamp(0.0, 1.0) * 65535.0).round() / 65535.0,
        Storage::Float16 => f16::from_f32(value).to_f32(),
        _ => value,
    }
}
