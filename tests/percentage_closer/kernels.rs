//! Kernels against brute force over random maps.

use moment_shadows::MapRegion;
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use crate::brute_force::{Convention, Layer, intensity, random_depths};
use crate::device::{self, PercentageCloserKernel, Query, Shader};

const IMPORTS: &str = "
import moment_shadows::techniques::percentage_closer::{PercentageCloserKernel, percentage_closer_binary, percentage_closer_box, percentage_closer_gaussian, percentage_closer_kernel};
";

/// The kernel's number is in `taps`.
const BODY: &str = "
alias Extra = PercentageCloserKernel;
fn answer(query: Query, plane: ReceiverPlane) -> f32 {
    let region = query.region;
    switch query.taps {
        case 0u: { return percentage_closer_binary(map, query.layer, region, plane, conversion); }
        case 1u: { return percentage_closer_box(map, query.layer, region, plane, conversion, i32(query.radius)); }
        case 2u: { return percentage_closer_gaussian(map, query.layer, region, plane, conversion, i32(query.radius), 0.4 * query.radius + 0.3); }
        default: { return percentage_closer_kernel(map, query.layer, region, plane, conversion, extra); }
    }
}
";

/// A map of odd size, and regions of two layers that touch.
const SIZE: [u32; 2] = [37, 23];

const REGIONS: [(u32, [u32; 2], [u32; 2]); 5] = [
    (0, [0, 0], [11, 23]),
    (0, [11, 0], [26, 9]),
    (0, [11, 9], [25, 14]),
    (0, [36, 9], [1, 14]),
    (1, [0, 0], SIZE),
];

fn query(random: &mut ChaCha8Rng, convention: Convention) -> Query {
    let (layer, origin, extent) = REGIONS[random.random_range(0..REGIONS.len())];
    // Some lie outside of their region.
    let uv = [(); 2].map(|()| random.random_range(-0.2..1.2_f32));
    let perspective = matches!(convention, Convention::Perspective { .. });
    Query {
        region: MapRegion::new(origin, extent),
        layer,
        gradient: [(); 2].map(|()| random.random_range(-0.05..0.05)),
        light_depth: if perspective { -1.25 } else { -1e30 },
        // Not past the light.
        bias: random.random_range(-0.1..0.1),
        ..Query::new(uv, random.random_range(-1.1..1.2), SIZE)
    }
}

#[test]
fn every_kernel_equals_brute_force() {
    let gpu = device::open();
    let shader = Shader::new(&gpu, IMPORTS, BODY);
    let mut random = ChaCha8Rng::seed_from_u64(4);
    let mut partial = 0;
    for convention in Convention::ALL {
        let stored = [(); 2].map(|()| random_depths(&mut random, SIZE, convention));
        let map = device::map(&gpu, wgpu::TextureFormat::Depth32Float, SIZE, &stored);
        let layers = stored
            .each_ref()
            .map(|stored| Layer::new(SIZE, convention, stored));
        for radius in 0..=8_usize {
            let given: Vec<f32> = (0..=2 * radius)
                .map(|_| random.random_range(0.0..3.0))
                .collect();
            let mut kernel = PercentageCloserKernel {
                radius: radius as u32,
                padding: [0; 3],
                weights: [[0.0; 4]; 33],
            };
            kernel.weights.as_flattened_mut()[..given.len()].copy_from_slice(&given);
            let sigma = f64::from(0.4_f32 * radius as f32 + 0.3);
            let gaussian =
                |offset: usize| (-0.5 * ((offset as f64 - radius as f64) / sigma).powi(2)).exp();
            let kernels: [Vec<f64>; 4] = [
                vec![1.0],
                vec![1.0; 2 * radius + 1],
                (0..=2 * radius).map(gaussian).collect(),
                given.iter().map(|&weight| f64::from(weight)).collect(),
            ];
            let queries: Vec<Query> = (0..160)
                .map(|index| Query {
                    radius: radius as f32,
                    taps: index % 4,
                    ..query(&mut random, convention)
                })
                .collect();
            let answers = shader.run(
                &map,
                wgpu::CompareFunction::Greater,
                convention.conversion(),
                bytemuck::bytes_of(&kernel),
                &queries,
            );
            for (query, answer) in queries.iter().zip(answers) {
                let kernel = query.taps as usize;
                let interpolated = kernel > 0;
                let [low, high] = intensity(
                    &layers[query.layer as usize],
                    query,
                    &kernels[kernel],
                    interpolated,
                );
                // Places are rounded to 2^-19 texels, of which the weights of a lookup change by as much; sums of up to 324
                // weights are rounded.
                let rounding = 1e-5;
                let answer = f64::from(answer);
                assert!(
                    answer >= low - rounding && answer <= high + rounding,
                    "{convention:?}, kernel {kernel} of radius {radius}: {answer}, not {low} to {high} for {query:?}"
                );
                partial += usize::from(answer > 0.01 && answer < 0.99);
            }
        }
    }
    assert!(partial > 4000, "only {partial} queries see some of both");
}

#[test]
fn the_largest_kernels_are_cut_off_at_64() {
    let gpu = device::open();
    let shader = Shader::new(&gpu, IMPORTS, BODY);
    let size = [160, 3];
    // An occluder covers the left half; the receiver lies 64.5 texels to the right of it.
    let stored: Vec<f32> = (0..480)
        .map(|texel| if texel % 160 < 80 { 0.25 } else { 1.0 })
        .collect();
    let map = device::map(&gpu, wgpu::TextureFormat::Depth32Float, size, &[stored]);
    let conversion = Convention::Orthographic { reversed: false }.conversion();
    let kernel = PercentageCloserKernel {
        radius: 1000,
        padding: [0; 3],
        weights: [[1.0; 4]; 33],
    };
    let ask = |column: f32, radius: f32, taps: u32| Query {
        radius,
        taps,
        ..Query::new([column / 160.0, 0.5], 0.5, size)
    };
    let queries = [
        ask(144.5, 64.0, 1),
        ask(143.5, 64.0, 1),
        ask(144.5, 1e9, 1),
        ask(143.5, 1e9, 1),
        ask(144.5, 0.0, 3),
        ask(143.5, 0.0, 3),
        ask(80.5, -5.0, 1),
        ask(79.5, -5.0, 1),
    ];
    let found = shader.run(
        &map,
        wgpu::CompareFunction::Greater,
        conversion,
        bytemuck::bytes_of(&kernel),
        &queries,
    );
    let expected = [
        0.0,
        1.0 / 129.0,
        0.0,
        1.0 / 129.0,
        0.0,
        1.0 / 129.0,
        0.0,
        1.0,
    ];
    for (found, expected) in found.into_iter().zip(expected) {
        // Sums of 16641 equal terms in single precision.
        assert!(
            (found - expected).abs() < 1e-5_f32,
            "{found}, not {expected}"
        );
    }
}

#[test]
fn gradients_are_shortened_to_the_steepest() {
    let gpu = device::open();
    let shader = Shader::new(&gpu, IMPORTS, BODY);
    let mut random = ChaCha8Rng::seed_from_u64(5);
    let convention = Convention::Orthographic { reversed: false };
    let stored = random_depths(&mut random, SIZE, convention);
    let map = device::map(
        &gpu,
        wgpu::TextureFormat::Depth32Float,
        SIZE,
        std::slice::from_ref(&stored),
    );
    let layer = Layer::new(SIZE, convention, &stored);
    let mut differ = 0;
    for (gradient, steepest, shortened) in [
        ([0.3, -0.4], 0.05, [0.03, -0.04]),
        ([1e15, 0.0], 0.02, [0.02, 0.0]),
        ([0.03, 0.04], 0.06, [0.03, 0.04]),
        ([0.3, 0.4], 0.0, [0.0, 0.0]),
    ] {
        let queries: Vec<Query> = (0..50)
            .map(|_| Query {
                gradient,
                steepest,
                radius: 3.0,
                taps: 1,
                ..Query::new(
                    [(); 2].map(|()| random.random_range(0.0..1.0)),
                    random.random_range(-0.5..0.5),
                    SIZE,
                )
            })
            .collect();
        let answers = shader.run(
            &map,
            wgpu::CompareFunction::Greater,
            convention.conversion(),
            &[0; 544],
            &queries,
        );
        for (query, answer) in queries.iter().zip(answers) {
            let shortened = Query {
                gradient: shortened,
                ..*query
            };
            let [low, high] = intensity(&layer, &shortened, &[1.0; 7], true);
            let answer = f64::from(answer);
            // Sums of 64 weights, which change by as much as places are rounded.
            assert!(
                answer > low - 1e-5 && answer < high + 1e-5,
                "{answer}, not {low} to {high} for {query:?}"
            );
            differ += usize::from(intensity(&layer, query, &[1.0; 7], true)[0] != low);
        }
    }
    assert!(differ > 100, "only {differ} depend on the limit");
}

#[test]
fn weights_that_are_not_positive_count_for_nothing() {
    let gpu = device::open();
    let shader = Shader::new(&gpu, IMPORTS, BODY);
    let map = device::map(
        &gpu,
        wgpu::TextureFormat::Depth32Float,
        [4, 4],
        &[vec![0.0; 16]],
    );
    let conversion = Convention::Orthographic { reversed: false }.conversion();
    let query = Query {
        taps: 3,
        ..Query::new([0.5, 0.5], 0.5, [4, 4])
    };
    for (weights, expected) in [
        ([0.0; 3], 0.0),
        ([-1.0, -2.0, -3.0], 0.0),
        ([-5.0, 1.0, f32::MAX], 1.0),
    ] {
        let mut kernel = PercentageCloserKernel {
            radius: 1,
            padding: [0; 3],
            weights: [[0.0; 4]; 33],
        };
        kernel.weights.as_flattened_mut()[..3].copy_from_slice(&weights);
        let found = shader.run(
            &map,
            wgpu::CompareFunction::Greater,
            conversion,
            bytemuck::bytes_of(&kernel),
            &[query],
        );
        assert_eq!(found, [expected], "{weights:?}");
    }
}
