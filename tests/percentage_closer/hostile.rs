//! What no host should ask: an answer in [0, 1] all the same.

use bytemuck::Zeroable as _;
use moment_shadows::{AreaLight, DepthConversion, DepthRange, LightSize, MapRegion};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use crate::device::{self, Query, Shader};
use crate::slopes::{BODY, IMPORTS, TESTS};

const SIZE: [u32; 2] = [9, 7];

fn soft() -> AreaLight {
    let range = DepthRange {
        near: 1.0,
        far: 3.0,
    };
    AreaLight::new(LightSize::Disk(0.5), [0.1, 0.2], range, 0.0..=9.0).unwrap()
}

/// Casters in the middle of the range on the left, none on the right.
fn half(gpu: &moment_shadows_lab::gpu::Gpu) -> wgpu::Texture {
    let stored = (0..SIZE[0] * SIZE[1])
        .map(|texel| if texel % SIZE[0] < 4 { 0.5 } else { 1.0 })
        .collect();
    device::map(gpu, wgpu::TextureFormat::Depth32Float, SIZE, &[stored])
}

#[test]
fn depths_that_are_no_numbers_count_as_an_end() {
    let gpu = device::open();
    let shader = Shader::new(&gpu, IMPORTS, BODY);
    let map = half(&gpu);
    for test in 0..TESTS {
        let ask = |depth: f32| Query {
            taps: test,
            radius: 1.0,
            ..Query::new([0.1, 0.5], depth, SIZE)
        };
        let queries = [
            f32::NAN,
            f32::INFINITY,
            f32::MAX,
            f32::NEG_INFINITY,
            f32::MIN,
            -0.001,
        ]
        .map(ask);
        let found = shader.run(
            &map,
            wgpu::CompareFunction::Greater,
            DepthConversion::orthographic(),
            bytemuck::bytes_of(&soft()),
            &queries,
        );
        // Soft shadows search farther than the casters reach.
        let behind = if test == 5 { 0.1 } else { 1.0 - 1e-6 };
        assert!(
            found[..3].iter().all(|&intensity| intensity >= behind),
            "test {test}: {found:?}"
        );
        assert_eq!(found[3..], [0.0; 3], "test {test}");
        // At the far end, where texels without a caster are, too.
        let empty = [1.0, 2.0, f32::NAN].map(|depth| Query {
            uv: [0.95, 0.5],
            ..ask(depth)
        });
        let found = shader.run(
            &map,
            wgpu::CompareFunction::Greater,
            DepthConversion::orthographic(),
            bytemuck::bytes_of(&soft()),
            &empty,
        );
        assert!(test == 5 || found == [0.0; 3], "test {test}: {found:?}");
    }
}

#[test]
fn a_region_without_texels_shadows_nothing() {
    let gpu = device::open();
    let shader = Shader::new(&gpu, IMPORTS, BODY);
    let map = half(&gpu);
    for test in 0..TESTS {
        let queries = [[0, 0], [0, 7], [4, 0], [4, 7]].map(|extent| Query {
            taps: test,
            radius: 1.0,
            region: MapRegion::new([0, 0], extent),
            ..Query::new([0.1, 0.5], 1.0, SIZE)
        });
        let found = shader.run(
            &map,
            wgpu::CompareFunction::Greater,
            DepthConversion::orthographic(),
            bytemuck::bytes_of(&soft()),
            &queries,
        );
        assert_eq!(found[..3], [0.0; 3], "test {test}");
        // Its texels would.
        assert!(found[3] > 0.9, "test {test}: {found:?}");
    }
}

#[test]
fn no_finite_input_leaves_the_unit_interval() {
    let gpu = device::open();
    let shader = Shader::new(&gpu, IMPORTS, BODY);
    let mut random = ChaCha8Rng::seed_from_u64(6);
    let map = half(&gpu);
    let extremes = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        1e-40,
        -1e-40,
        1e9,
        -1e9,
        1e18,
        -1e18,
        3e38,
        -3e38,
        f32::MAX,
        f32::MIN,
    ];
    let mut any = || extremes[random.random_range(0..extremes.len())];
    let mut queries: Vec<Query> = (0..6000_u32)
        .map(|index| Query {
            gradient: [any(), any()],
            light_depth: -any().abs(),
            radius: any().clamp(-1e9, 16.0),
            angle: any(),
            taps: index % TESTS,
            steepest: any(),
            bias: any(),
            ..Query::new([any(), any()], any(), SIZE)
        })
        .collect();
    for (index, query) in queries.iter_mut().enumerate() {
        if index % 5 == 0 {
            query.region = MapRegion::new([3, 2], [(index % 3) as u32, (index % 4) as u32]);
        }
    }
    let mut lights = vec![soft(), AreaLight::zeroed()];
    lights.push(AreaLight {
        size: [3e38, 1e-40],
        near: -3e38,
        far: 3e38,
        largest_radius: 3e38,
        smallest_radius: 5.0,
        ..soft()
    });
    lights.push(AreaLight {
        near: 0.0,
        far: 0.0,
        smallest_radius: -3.0,
        largest_radius: -2.0,
        ..soft()
    });
    let conversions = [
        DepthConversion::orthographic(),
        DepthConversion::perspective(
            0.01,
            f64::INFINITY,
            DepthRange {
                near: 0.01,
                far: 1e4,
            },
        )
        .unwrap()
        .reversed(),
        DepthConversion::zeroed(),
    ];
    for (light, conversion) in lights
        .iter()
        .flat_map(|light| conversions.map(|conversion| (light, conversion)))
    {
        let found = shader.run(
            &map,
            wgpu::CompareFunction::Greater,
            conversion,
            bytemuck::bytes_of(light),
            &queries,
        );
        for (query, found) in queries.iter().zip(found) {
            assert!(
                (0.0..=1.0).contains(&found),
                "{found} for {query:?}, {light:?}"
            );
            let empty = query.region.extent.contains(&0);
            assert!(!empty || found == 0.0, "{found} without a region");
        }
    }
}
