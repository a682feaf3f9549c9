//! Comparison samplers against loaded texels.

use moment_shadows::MapRegion;
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

use crate::brute_force::{Convention, random_depths};
use crate::device::{self, Query, Shader};

const IMPORTS: &str = "
import moment_shadows::techniques::percentage_closer::{percentage_closer_box};
import moment_shadows::techniques::percentage_closer_hardware::{percentage_closer_hardware_box};
";

const BODY: &str = "
alias Extra = vec4f;
fn answer(query: Query, plane: ReceiverPlane) -> f32 {
    if query.taps == 0u {
        return percentage_closer_box(map, query.layer, query.region, plane, conversion, i32(query.radius));
    }
    return percentage_closer_hardware_box(map, comparison, query.layer, query.region, plane, conversion, i32(query.radius));
}
";

const SIZE: [u32; 2] = [37, 23];

/// Weights of a lookup have 8 bits at least: each of the two fractions is off by half of 2^-8 where it is rounded and by
/// all of it where it is cut off, and the blend of zeros and ones by their sum. Next to the border of a region taps keep
/// 2^-9 away from it.
const WEIGHTS: f32 = 3.0 / 256.0;

fn queries(random: &mut ChaCha8Rng, gradient: f32) -> Vec<Query> {
    (0..500)
        .map(|_| {
            let regions = [
                ([0, 0], [11, 23]),
                ([11, 0], [26, 9]),
                ([11, 9], [26, 14]),
                ([3, 3], [1, 1]),
            ];
            let (origin, extent) = regions[random.random_range(0..regions.len())];
            Query {
                region: MapRegion::new(origin, extent),
                layer: random.random_range(0..2),
                radius: random.random_range(0..=4) as f32,
                gradient: [(); 2].map(|()| random.random_range(-1.0..1.0) * gradient),
                ..Query::new(
                    [(); 2].map(|()| random.random_range(-0.1..1.1)),
                    random.random_range(-1.05..1.05),
                    SIZE,
                )
            }
        })
        .collect()
}

fn with_taps(queries: &[Query], taps: u32) -> Vec<Query> {
    queries
        .iter()
        .map(|query| Query { taps, ..*query })
        .collect()
}

#[test]
fn comparison_samplers_equal_interpolated_boxes() {
    let gpu = device::open();
    let shader = Shader::new(&gpu, IMPORTS, BODY);
    let mut random = ChaCha8Rng::seed_from_u64(8);
    let formats = [
        wgpu::TextureFormat::Depth32Float,
        wgpu::TextureFormat::Depth16Unorm,
    ];
    let mut partial = 0;
    for (convention, format) in Convention::ALL
        .into_iter()
        .flat_map(|c| formats.map(|f| (c, f)))
    {
        let compare = if convention.reversed() {
            wgpu::CompareFunction::Less
        } else {
            wgpu::CompareFunction::Greater
        };
        let stored = [(); 2].map(|()| random_depths(&mut random, SIZE, convention));
        let map = device::map(&gpu, format, SIZE, &stored);
        for gradient in [0.0, 0.03] {
            let queries = queries(&mut random, gradient);
            let [loaded, sampled] = [0, 1].map(|taps| {
                shader.run(
                    &map,
                    compare,
                    convention.conversion(),
                    &[0; 16],
                    &with_taps(&queries, taps),
                )
            });
            for ((query, loaded), sampled) in queries.iter().zip(loaded).zip(sampled) {
                assert!((0.0..=1.0).contains(&sampled));
                // On a slope the least depth of the plane stands in for it, which misses some casters, and finds none more.
                let missed = if gradient == 0.0 {
                    sampled - loaded
                } else {
                    (sampled - loaded).max(0.0)
                };
                assert!(
                    missed.abs() < WEIGHTS,
                    "{convention:?}, {format:?}: {sampled}, loaded {loaded} for {query:?}"
                );
                partial += usize::from(loaded > 0.1 && loaded < 0.9);
            }
        }
    }
    assert!(partial > 5000, "only {partial} queries see some of both");
}

#[test]
fn on_a_slope_casters_that_stand_clear_of_it_are_found() {
    let gpu = device::open();
    let shader = Shader::new(&gpu, IMPORTS, BODY);
    let mut random = ChaCha8Rng::seed_from_u64(9);
    let convention = Convention::Orthographic { reversed: false };
    // Casters at the near end or none.
    let stored: Vec<f32> = (0..SIZE[0] * SIZE[1])
        .map(|_| random.random_range(0..2) as f32)
        .collect();
    let map = device::map(
        &gpu,
        wgpu::TextureFormat::Depth32Float,
        SIZE,
        &[stored.clone(), stored],
    );
    let mut queries = queries(&mut random, 0.02);
    for query in &mut queries {
        query.depth = 0.3;
    }
    let [loaded, sampled] = [0, 1].map(|taps| {
        let queries = with_taps(&queries, taps);
        shader.run(
            &map,
            wgpu::CompareFunction::Greater,
            convention.conversion(),
            &[0; 16],
            &queries,
        )
    });
    for ((query, loaded), sampled) in queries.iter().zip(loaded).zip(sampled) {
        assert!(
            (sampled - loaded).abs() < WEIGHTS,
            "{sampled}, loaded {loaded} for {query:?}"
        );
    }
}

#[test]
fn nothing_is_nearer_than_the_near_end() {
    let gpu = device::open();
    let shader = Shader::new(&gpu, IMPORTS, BODY);
    // A caster in front of the range of moment depth.
    let map = device::map(
        &gpu,
        wgpu::TextureFormat::Depth32Float,
        SIZE,
        &[vec![0.1; (SIZE[0] * SIZE[1]) as usize]],
    );
    let ask = |depth, taps| Query {
        taps,
        ..Query::new([0.5, 0.5], depth, SIZE)
    };
    let queries = [
        ask(-1.0, 0),
        ask(-1.0, 1),
        ask(-2.0, 1),
        ask(-0.99, 0),
        ask(-0.99, 1),
    ];
    let found = shader.run(
        &map,
        wgpu::CompareFunction::Greater,
        Convention::Linear.conversion(),
        &[0; 16],
        &queries,
    );
    assert_eq!(found, [0.0, 0.0, 0.0, 1.0, 1.0]);
}
