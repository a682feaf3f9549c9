//! Moments of what lies between the ends of the range: bounds that contain the truth and are tighter than those of whole
//! distributions.

use bytemuck::{Pod, Zeroable};
use moment_shadows::Storage;
use moment_shadows_lab::batch::Batch;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::stage::gpu;

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Input {
    depths: [f32; 6],
    weights: [f32; 6],
    depth: f32,
    storage: u32,
    padding: [f32; 2],
    texels: [[f32; 4]; 2],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Output {
    apart: [f32; 2],
    whole: [f32; 2],
    of_texels: [f32; 2],
    padding: [f32; 2],
    /// Odd and even moments apart from the ends, then those of the whole.
    texels: [[f32; 4]; 4],
}

fn run(inputs: &[Input]) -> Vec<Output> {
    Batch::new(&gpu(), "enclosed.wgsl", include_str!("enclosed.wgsl"))
        .unwrap()
        .run(inputs)
        .unwrap()
}

/// Occluders with weights of any size, of which `front` lie before the range, `back` behind it, and the others within.
fn occluders(random: &mut ChaCha8Rng, front: usize, back: usize, storage: Storage) -> Input {
    let mut depths: [f32; 6] = std::array::from_fn(|index| match index {
        _ if index < front => random.random_range(-3.0..-1.0),
        _ if index < front + back => random.random_range(1.0..3.0),
        _ => random.random_range(-0.99..0.99),
    });
    depths[0] = depths[0].clamp(-1.0, 1.0);
    let shares: [f32; 6] = std::array::from_fn(|_| 10.0_f32.powf(random.random_range(-3.0..0.0)));
    let sum: f32 = shares.iter().sum();
    Input {
        depths,
        weights: shares.map(|share| share / sum),
        depth: random.random_range(-1.0..1.0),
        storage: storage.wgsl_index(),
        padding: [0.0; 2],
        texels: [[0.0; 4]; 2],
    }
}

/// Weight before the depth.
fn before(input: &Input) -> f64 {
    let pairs = input.depths.iter().zip(&input.weights);
    pairs
        .filter(|(depth, _)| **depth < input.depth || **depth <= -1.0)
        .map(|(_, weight)| f64::from(*weight))
        .sum()
}

#[test]
fn bounds_contain_the_truth_and_are_tighter_than_those_of_whole_distributions() {
    let mut random = ChaCha8Rng::seed_from_u64(6);
    // What biasing moves at most, and what rounding of both weights adds: 2^-12 of float16, 2^-17 of unorm16.
    for (storage, tolerance) in [
        (Storage::Float16, 1.5e-3 + 5e-4),
        (Storage::Unorm16, 1e-4 + 5e-5),
        (Storage::Float32, 1e-5 + 2e-6),
    ] {
        let inputs: Vec<Input> = (0..60_000)
            .map(|number| occluders(&mut random, number % 3, number / 3 % 3, storage))
            .collect();
        let mut gaps = [0.0; 2];
        for (input, found) in inputs.iter().zip(run(&inputs)) {
            let truth = before(input);
            let [low, high] = found.apart.map(f64::from);
            assert!(
                (0.0..=1.0).contains(&low) && low <= high && high <= 1.0,
                "{input:?}: {found:?}"
            );
            assert!(
                low <= truth + tolerance && high >= truth - tolerance,
                "{storage}: {truth} in {low}..{high}, {input:?}"
            );
            gaps[0] += high - low;
            gaps[1] += f64::from(found.whole[1] - found.whole[0]);
        }
        // A third of the inputs has nothing at the ends.
        assert!(
            gaps[0] < 0.75 * gaps[1],
            "{storage}: mean gaps {gaps:?} of {} inputs",
            inputs.len()
        );
    }
}

#[test]
fn one_rounding_to_eight_bits_leaves_bounds_that_contain_the_truth() {
    let mut random = ChaCha8Rng::seed_from_u64(8);
    let inputs: Vec<Input> = (0..100_000)
        .map(|number| occluders(&mut random, number % 3, number / 3 % 3, Storage::Unorm8))
        .collect();
    // What biasing moves at most, and what rounding of both weights adds.
    let tolerance = 1.2e-2 + 2.0 * 0.5 / 255.0;
    let (mut beyond, mut far_beyond) = (0, 0);
    let mut gap = 0.0;
    for (input, found) in inputs.iter().zip(run(&inputs)) {
        let truth = before(input);
        let [low, high] = found.apart.map(f64::from);
        assert!((0.0..=1.0).contains(&low) && low <= high && high <= 1.0);
        let error = (low - truth).max(truth - high);
        beyond += usize::from(error > tolerance);
        far_beyond += usize::from(error > tolerance + 0.05);
        gap += high - low;
    }
    let mean = gap / inputs.len() as f64;
    println!("{beyond} beyond, {far_beyond} of them far, mean gap {mean:.4}");
    // 99.9 % are not beyond. With half of the bias ten times as many are.
    assert!(beyond <= 150 && far_beyond <= 15, "{beyond} {far_beyond}");
    // Six moments without any rounding have 0.06.
    assert!(mean < 0.1, "{mean}");
}

#[test]
fn what_lies_at_the_ends_is_exact() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    for storage in Storage::OF_FOUR_MOMENTS {
        let mut inputs = Vec::new();
        for front in 0..=6 {
            for _ in 0..100 {
                inputs.push(occluders(&mut random, front, 6 - front, storage));
            }
        }
        for (input, found) in inputs.iter().zip(run(&inputs)) {
            let [low, high] = found.apart;
            assert_eq!(low, high, "{input:?}");
            // Half a unit of float16 below 1.
            let error = f64::from(low) - before(input);
            assert!(error.abs() <= 2.5e-4, "{storage}: {error} {input:?}");
        }
        // Nothing at all, and nothing but shadow: to the bit.
        for (depth, shadow) in [(1.0, 0.0), (-1.0, 1.0)] {
            let input = Input {
                depths: [depth; 6],
                weights: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
                ..inputs[0]
            };
            assert_eq!(run(&[input])[0].apart, [shadow; 2], "{storage}");
        }
    }
}

/// The smallest weight whose depth matters: `ENCLOSED_MOMENTS_SMALLEST_WEIGHT`.
#[test]
fn the_depth_of_occluders_matters_from_a_weight_on() {
    let smallest: f32 = 0.001_953_125;
    let of = |weight: f32| {
        let input = Input {
            // Far in front of the depth; the others lie behind the range.
            depths: [-0.5, 1.0, 1.0, 1.0, 1.0, 1.0],
            weights: [weight, 1.0 - weight, 0.0, 0.0, 0.0, 0.0],
            depth: 0.5,
            storage: Storage::Float32.wgsl_index(),
            padding: [0.0; 2],
            texels: [[0.0; 4]; 2],
        };
        run(&[input])[0].apart
    };
    let [low, high] = of(smallest);
    assert!(low > 0.99 * smallest && high <= smallest, "{low} {high}");
    let less = smallest.next_down();
    assert_eq!(of(less), [0.0, less]);
}

#[test]
fn maps_of_whole_distributions_are_read_alike() {
    let mut random = ChaCha8Rng::seed_from_u64(8);
    for storage in Storage::OF_FOUR_MOMENTS {
        let inputs: Vec<Input> = (0..2000)
            .map(|_| occluders(&mut random, 0, 0, storage))
            .collect();
        for (input, found) in inputs.iter().zip(run(&inputs)) {
            let [odd, even, whole_odd, whole_even] = found.texels;
            let pairs = odd
                .iter()
                .chain(&even)
                .zip(whole_odd.iter().chain(&whole_even));
            for (apart, whole) in pairs {
                // The weights' sum is 1 but for rounding; then a rounding to the storage may fall the other way.
                let unit = match storage {
                    Storage::Float16 => 5e-4,
                    Storage::Unorm16 => 1.6e-5,
                    _ => 4e-6,
                };
                assert!(
                    (apart - whole).abs() <= unit,
                    "{storage}: {found:?} {input:?}"
                );
            }
        }
    }
}

#[test]
fn broken_texels_have_bounds() {
    let mut random = ChaCha8Rng::seed_from_u64(9);
    let special = [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::MAX,
        -f32::MAX,
        0.0,
        1.0,
        -1.0,
        1e-30,
        0.5,
    ];
    let inputs: Vec<Input> = (0..30_000)
        .map(|number| {
            let storage = Storage::OF_FOUR_MOMENTS[number % 2 + 1];
            let texels = [0; 2].map(|_| {
                [0; 4].map(|_| match random.random_range(0..3) {
                    0 => special[random.random_range(0..special.len())],
                    1 => random.random_range(-2.0..2.0),
                    _ => f32::from_bits(random.random()),
                })
            });
            Input {
                texels,
                ..occluders(&mut random, 1, 1, storage)
            }
        })
        .collect();
    for (input, found) in inputs.iter().zip(run(&inputs)) {
        let [low, high] = found.of_texels;
        assert!(
            (0.0..=1.0).contains(&low) && low <= high && high <= 1.0,
            "{input:?}: {low} {high}"
        );
    }
}
