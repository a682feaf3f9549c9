//! Texels that are rounded inwards: valid with a third of their bias, and near the moments that they stand for.

use bytemuck::{Pod, Zeroable};
use half::f16;
use moment_shadows::{FourMomentsBias, Profile, Storage};
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use super::packed::{distribution, moments};

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
struct Input {
    moments: [f32; 4],
    storage: u32,
    padding: [u32; 3],
}

/// The number of the storage that is nearest to a channel, and the step there.
fn stored(storage: Storage, channel: f64) -> [f64; 2] {
    match storage {
        Storage::Unorm16 => [(channel * 65535.0).round() / 65535.0, 1.0 / 65535.0],
        _ => {
            let magnitude = channel.abs().max(2_f64.powi(-14));
            let step = 2_f64.powf(magnitude.log2().floor() - 10.0);
            [f16::from_f64(channel).to_f64(), step]
        }
    }
}

/// The channels of moments, as a storage centres them.
fn channels(storage: Storage, [b1, b2, b3, b4]: [f64; 4]) -> [f64; 4] {
    let root = 3_f64.sqrt();
    let centre = if storage == Storage::Float16 {
        0.5
    } else {
        0.0
    };
    [
        1.5 * b1 - 2.0 * b3 + 0.5,
        4.0 * (b2 - b4),
        root * (0.5 * b1 - 2.0 / 9.0 * b3) + 0.5,
        0.5 * (b2 + b4),
    ]
    .map(|channel| channel - centre)
}

fn of_channels(storage: Storage, channels: [f64; 4]) -> [f64; 4] {
    let root = 3_f64.sqrt();
    let centre = if storage == Storage::Float16 {
        0.5
    } else {
        0.0
    };
    let [x, y, z, w] = channels.map(|channel| channel + centre);
    let (x, z) = (x - 0.5, z - 0.5);
    [
        root * z - x / 3.0,
        w + y / 8.0,
        0.75 * (root * z - x),
        w - y / 8.0,
    ]
}

/// Variance and determinant of the Hankel matrix of moments with a part of a bias; both are positive where some distribution has these.
fn pivots(b: [f64; 4], bias: FourMomentsBias, share: f64) -> [f64; 2] {
    let alpha = share * f64::from(bias.alpha);
    let target = [0.0, f64::from(bias.second), 0.0, f64::from(bias.fourth)];
    let [b1, b2, b3, b4] =
        core::array::from_fn(|index| b[index] + alpha * (target[index] - b[index]));
    let (variance, covariance) = (b2 - b1 * b1, b3 - b1 * b2);
    [
        variance,
        variance * (b4 - b2 * b2) - covariance * covariance,
    ]
}

fn inputs(exact: &[[f64; 4]], storage: Storage) -> Vec<Input> {
    let input = |b: &[f64; 4]| Input {
        moments: b.map(|moment| moment as f32),
        storage: storage.wgsl_index(),
        ..Input::default()
    };
    exact.iter().map(input).collect()
}

#[test]
fn texels_are_valid_with_half_the_bias_and_hug_the_boundary() {
    let mut random = ChaCha8Rng::seed_from_u64(8);
    let exact: Vec<[f64; 4]> = (0..200_000)
        .map(|_| moments(&distribution(&mut random)))
        .collect();
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let batch = Batch::new(&gpu, "inwards.wgsl", include_str!("inwards.wgsl")).unwrap();
    for storage in [Storage::Unorm16, Storage::Float16] {
        let inputs = inputs(&exact, storage);
        let texels: Vec<[f32; 4]> = batch.run(&inputs).unwrap();
        let [inwards, nearest] = [storage.moment_bias_rounded_inwards(), storage.moment_bias()];
        let (mut invalid, mut invalid_nearest, mut beyond) = (0, 0, 0);
        let (mut excess, mut excess_nearest, mut farthest) = (0.0, 0.0, 0.0_f64);
        for (texel, &b) in texels.iter().zip(&exact) {
            let given = channels(storage, b);
            let nearest_texel = given.map(|channel| stored(storage, channel)[0]);
            // What a texture holds of it.
            let texel = texel.map(|channel| stored(storage, channel.into())[0]);
            let apart = |index: usize| (texel[index] - given[index]).abs();
            farthest = (0..4).map(apart).fold(farthest, f64::max);
            beyond +=
                usize::from((0..4).any(|it| apart(it) > 1.02 * stored(storage, given[it])[1]));
            let [own, other] = [texel, nearest_texel].map(|it| of_channels(storage, it));
            let is_valid = |b, bias| pivots(b, bias, 0.5).iter().all(|pivot| *pivot > 0.0);
            invalid += usize::from(!is_valid(own, inwards));
            invalid_nearest += usize::from(!is_valid(other, inwards));
            let determinant = pivots(b, inwards, 0.0)[1];
            excess += pivots(own, inwards, 1.0)[1] - determinant;
            excess_nearest += pivots(other, nearest, 1.0)[1] - determinant;
        }
        let count = exact.len() as f64;
        let [beyond, with_nearest] =
            [beyond, invalid_nearest].map(|it| f64::from(it as u32) / count);
        println!(
            "{storage}: {invalid} invalid, of the nearest {with_nearest:.3}; more than a step off {beyond:.4}, at most {farthest:.1e}; \
             determinants {:.3} of those with the nearest and its bias",
            excess / excess_nearest
        );
        assert_eq!(invalid, 0, "{storage}");
        // The distributions are hard enough to tell.
        assert!(with_nearest > 0.1, "{storage}");
        // Moments of one surface are moved at times, by less than four times the bias, before they are rounded to the nearest.
        assert!(beyond < 0.1, "{storage}");
        assert!(farthest < 5.0 * f64::from(inwards.alpha), "{storage}");
        assert!(excess < 0.6 * excess_nearest, "{storage}");
    }
}

/// The first channel of one surface at -1/2 is 0, or what rounding makes of it; a texel is found beside it all the same.
#[test]
fn where_a_channel_ends_a_step_is_far_enough() {
    let storage = Storage::Unorm16;
    let depths = (-2000..=2000).map(|step| -0.5 + f64::from(step) * 5e-8);
    let exact: Vec<[f64; 4]> = depths.map(|depth| moments(&[[depth, 1.0]])).collect();
    let inputs = inputs(&exact, storage);
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let batch = Batch::new(&gpu, "inwards.wgsl", include_str!("inwards.wgsl")).unwrap();
    let texels: Vec<[f32; 4]> = batch.run(&inputs).unwrap();
    for (texel, b) in texels.iter().zip(exact) {
        for (found, given) in texel.iter().zip(channels(storage, b)) {
            let [_, step] = stored(storage, given);
            let apart = (f64::from(*found) - given).abs();
            assert!(apart <= 1.02 * step, "{texel:?} of {b:?}");
        }
    }
}
