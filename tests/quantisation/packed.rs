//! Packed texels: what they keep of moments, and that whatever they hold is a distribution.

use bytemuck::{Pod, Zeroable};
use moment_shadows::{Profile, Storage};
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::HALF_ULP;

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
struct Input {
    moments: [[f32; 4]; 4],
    place: [f32; 2],
    unused: [f32; 2],
    texels: [[u32; 4]; 4],
    fragment_depth: f32,
    storage: u32,
    as_given: u32,
    padding: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Output {
    first: [f32; 4],
    average: [f32; 4],
    mean: [f32; 4],
    intensity: f32,
    is_kept: u32,
    padding: [u32; 2],
}

fn run(inputs: &[Input]) -> Vec<Output> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    Batch::new(&gpu, "packed.wgsl", include_str!("packed.wgsl"))
        .unwrap()
        .run(inputs)
        .unwrap()
}

/// Atoms and their weights: apart, close together, on a slope, at the ends.
pub(super) fn distribution(random: &mut ChaCha8Rng) -> Vec<[f64; 2]> {
    let count = random.random_range(1..=5);
    let spread = 10_f64.powf(random.random_range(-6.0..=0.3));
    let middle: f64 = random.random_range(-1.0..=1.0);
    let mut atoms: Vec<[f64; 2]> = (0..count)
        .map(|_| {
            let depth = middle + spread * random.random_range(-1.0..=1.0);
            [depth.clamp(-1.0, 1.0), random.random_range(0.01..=1.0)]
        })
        .collect();
    let total: f64 = atoms.iter().map(|[_, weight]| weight).sum();
    atoms.iter_mut().for_each(|atom| atom[1] /= total);
    atoms
}

pub(super) fn moments(atoms: &[[f64; 2]]) -> [f64; 4] {
    core::array::from_fn(|index| {
        let of = |&[depth, weight]: &[f64; 2]| weight * depth.powi(index as i32 + 1);
        atoms.iter().map(of).sum()
    })
}

#[test]
fn packed_texels_keep_the_mean_and_move_no_depth_by_more_than_a_step() {
    let storage = Storage::Packed64;
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let distributions: Vec<_> = (0..60_000).map(|_| distribution(&mut random)).collect();
    let inputs: Vec<Input> = distributions
        .iter()
        .map(|atoms| Input {
            moments: [moments(atoms).map(|moment| moment as f32); 4],
            storage: storage.wgsl_index(),
            ..Input::default()
        })
        .collect();
    // Steps from -1 to 1, and from 0 to 1.
    let [depths, weights, roots] = [65534.0, 65535.0, 65535.0];
    let (mut mean, mut largest) = (0.0_f64, [0.0_f64; 3]);
    for (output, atoms) in run(&inputs).iter().zip(&distributions) {
        assert_eq!(output.is_kept, 1, "{atoms:?}");
        let exact = moments(atoms);
        let error = |index: usize| (f64::from(output.first[index]) - exact[index]).abs();
        let [low, high] = [f64::min, f64::max].map(|least| {
            let depths = atoms.iter().map(|atom| atom[0]);
            depths.reduce(least).unwrap()
        });
        // Both nodes lie between the outermost atoms but for a step outwards; the weight is within a step.
        let between = high - low + 4.0 / depths;
        mean = mean.max(error(0) - between / weights);
        for index in 1..4 {
            largest[index - 1] = largest[index - 1].max(error(index));
        }
    }
    println!("{storage}: the mean beyond its limit {mean:.1e}, other moments within {largest:?}");
    // Some roundings of numbers up to 1, in f32, and those of a place among 65535.
    assert!(mean <= 16.0 * HALF_ULP, "{storage}: {mean:e}");
    // A node moved by a step of 2 / n changes its k-th power by up to k of them, and the weight's error of a step that by up to two; the
    // fourth moment has the pivot as well, whose root moves by half a step.
    let of_power = |power: f64| power * 2.0 / depths + 2.0 / weights;
    for (index, largest) in largest.into_iter().enumerate() {
        let power = index as f64 + 2.0;
        let pivot = if index == 2 { 1.0 / roots } else { 0.0 };
        assert!(
            largest <= of_power(power) + pivot + 16.0 * HALF_ULP,
            "{storage}: {largest:e}"
        );
    }
}

/// Whatever integers texels hold, an average of four has positive pivots with the bias, and without it some have not.
#[test]
fn any_packed_texels_give_valid_moments_and_intensities() {
    let storage = Storage::Packed64;
    let mut random = ChaCha8Rng::seed_from_u64(6);
    let bias = storage.moment_bias();
    let inputs: Vec<Input> = (0..200_000)
        .map(|number| {
            let first: [u32; 4] = core::array::from_fn(|_| random.random());
            // Texels of one surface are alike, and pivots smallest there.
            let alike = number % 2 == 0;
            let texels = core::array::from_fn(|index| match alike {
                true => first.map(|word| {
                    word ^ ((random.random::<u32>() & 0x0003_0003) * u32::from(index > 0))
                }),
                false => core::array::from_fn(|_| random.random()),
            });
            Input {
                texels,
                place: [random.random(), random.random()],
                fragment_depth: random.random_range(-1.2..=1.2),
                storage: storage.wgsl_index(),
                as_given: 1,
                ..Input::default()
            }
        })
        .collect();
    let outputs = run(&inputs);
    let apart = outputs.iter().flat_map(|output| {
        let pairs = output.mean.into_iter().zip(output.average);
        pairs.map(|(mean, average)| f64::from(mean - average).abs())
    });
    let apart = apart.fold(0.0, f64::max);
    println!("{storage}: the mean of a gather is within {apart:.1e} of the average");
    assert!(apart <= 16.0 * HALF_ULP, "{apart:e}");
    let failures = |alpha: f64| {
        let [second, fourth] = [bias.second, bias.fourth].map(f64::from);
        outputs
            .iter()
            .filter(|output| {
                let b = output.mean.map(f64::from);
                let [b1, b3] = [b[0], b[2]].map(|moment| moment - alpha * moment);
                let b2 = b[1] + alpha * (second - b[1]);
                let b4 = b[3] + alpha * (fourth - b[3]);
                let variance = b2 - b1 * b1;
                let covariance = b3 - b1 * b2;
                variance <= 0.0 || b4 - b2 * b2 - covariance * covariance / variance <= 0.0
            })
            .count()
    };
    let (with, without) = (failures(f64::from(bias.alpha)), failures(0.0));
    println!(
        "{storage}: impossible moments of {}: {with} with the bias, {without} without",
        outputs.len()
    );
    assert_eq!(with, 0);
    assert!(without > 0);
    let valid = |output: &Output| (0.0..=1.0).contains(&output.intensity);
    assert!(outputs.iter().all(valid));
}

/// A surface that is lit by its own depth: it casts no shadow on itself a depth's step in front, and a full one well behind.
#[test]
fn a_packed_surface_is_lit_in_front_and_shadowed_behind() {
    let (storage, in_front, behind) = (Storage::Packed64, 1e-4, 0.01);
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let mut inputs = Vec::new();
    for _ in 0..20_000 {
        let depth: f64 = random.random_range(-0.85..=0.85);
        for offset in [-in_front, behind] {
            inputs.push(Input {
                moments: [moments(&[[depth, 1.0]]).map(|moment| moment as f32); 4],
                place: [0.5; 2],
                fragment_depth: (depth + offset) as f32,
                storage: storage.wgsl_index(),
                ..Input::default()
            });
        }
    }
    let outputs = run(&inputs);
    let darkest = outputs.iter().step_by(2).map(|it| it.intensity);
    let darkest = darkest.fold(0.0, f32::max);
    let lightest = outputs.iter().skip(1).step_by(2).map(|it| it.intensity);
    let lightest = lightest.fold(1.0, f32::min);
    println!("{storage}: at most {darkest:.4} in front, at least {lightest:.4} behind");
    assert!(darkest <= 0.02, "{storage}: {darkest}");
    assert!(lightest >= 0.98, "{storage}: {lightest}");
}
