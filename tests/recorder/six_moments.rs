//! Maps of six moments, made on the adapter in every storage, against a reference in f64: resolved, blurred, with mip levels.

use half::f16;
use moment_shadows::{
    DepthConversion, Kernel, MapRegion, Profile, Storage, Technique, TextureFormat,
};
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::{ImportedResource, Layers};
use moment_shadows_lab::basis::{Quantisation, six_moments};
use moment_shadows_lab::gpu::Gpu;

use crate::depth_map;
use crate::regions::at_level;
use crate::setup::{Bound, bind, capabilities, compiled};

const MAP: [u32; 2] = [52, 38];

/// Two regions whose edge is aligned with nothing, and a column of texels that belong to none.
const REGIONS: [MapRegion; 2] = [
    MapRegion {
        origin: [1, 0],
        extent: [26, 38],
    },
    MapRegion {
        origin: [27, 3],
        extent: [25, 33],
    },
];

const RADIUS: u32 = 3;

fn graph(storage: Storage, kernel: &str, output: &str) -> String {
    format!(
        r#"{{
  "version": 2,
  "imports": [{{ "name": "light_depth" }}],
  "nodes": [
    {{ "name": "resolve", "type": "resolve",
       "properties": {{ "technique": "hamburger6", "storage": "{storage}" }} }},
    {{ "name": "blur", "type": "blur", "properties": {{ {kernel}, "mip_levels": 3 }} }},
    {{ "name": "downsample", "type": "downsample" }}
  ],
  "edges": [
    {{ "from": "light_depth", "to": "resolve.depth" }},
    {{ "from": "resolve.map", "to": "blur.map" }},
    {{ "from": "blur.blurred", "to": "downsample.map" }}
  ],
  "outputs": [{{ "name": "resolved", "from": "resolve.map" }}, {{ "name": "map", "from": "{output}" }}]
}}"#
    )
}

/// Steps, slopes and noise; samples of a texel differ at edges.
fn depths(layer: u32, samples: u32) -> Vec<f32> {
    depth_map::values([MAP[0] * samples, MAP[1]], |x, y| {
        let noise = (x.wrapping_mul(2_654_435_761) ^ y.wrapping_mul(40_503) ^ layer) >> 8 & 0xffff;
        match (x / (5 * samples) + y / 7 + layer) % 4 {
            0 => 0.2,
            1 => 0.3 + 0.005 * y as f32,
            2 => noise as f32 / 65536.0,
            _ => 1.0,
        }
    })
}

fn conversions() -> [DepthConversion; 2] {
    [
        DepthConversion::orthographic(),
        DepthConversion::orthographic().reversed(),
    ]
}

/// Three channels of a texel, without the one half that floats leave out.
fn channels(storage: Storage, bytes: &[u8]) -> Vec<[f64; 3]> {
    let of_half = |pair: &[u8]| f16::from_le_bytes([pair[0], pair[1]]).to_f64() + 0.5;
    let of_unorm = |pair: &[u8]| f64::from(u16::from_le_bytes([pair[0], pair[1]])) / 65535.0;
    match storage {
        Storage::Unorm10 => bytes
            .chunks_exact(4)
            .map(|four| {
                let bits = u32::from_le_bytes([four[0], four[1], four[2], four[3]]);
                // The fourth channel is 1 wherever anything was drawn.
                assert!(bits >> 30 == 3 || bits == 0, "{bits:x}");
                [0, 10, 20].map(|shift| f64::from(bits >> shift & 1023) / 1023.0)
            })
            .collect(),
        Storage::Unorm16 => bytes
            .chunks_exact(8)
            .map(|texel| [0, 2, 4].map(|at| of_unorm(&texel[at..])))
            .collect(),
        Storage::Float16 => bytes
            .chunks_exact(8)
            .map(|texel| [0, 2, 4].map(|at| of_half(&texel[at..])))
            .collect(),
        _ => bytemuck::pod_collect_to_vec::<u8, f32>(bytes)
            .chunks_exact(4)
            .map(|texel| [0, 1, 2].map(|at| f64::from(texel[at]) + 0.5))
            .collect(),
    }
}

/// Half a step of a storage for channels in [0, 1]: what one rounding is off by.
fn half_step(storage: Storage) -> f64 {
    match storage {
        Storage::Unorm10 => 0.5 / 1023.0,
        Storage::Unorm16 => 0.5 / 65535.0,
        // Within one half: 11 bits of numbers below it.
        Storage::Float16 => 1.0 / 8192.0,
        _ => 1.0 / f64::from(1 << 26),
    }
}

/// What f32 adds to a sum of products that encode or filter: 24 times a few units of 2^-25.
const ARITHMETIC: f64 = 3e-6;

/// A plane's texels on a mip level of an output.
fn read(
    gpu: &Gpu,
    bound: &Bound,
    storage: Storage,
    output: &str,
    array_layer: u32,
    level: u32,
) -> Vec<[f64; 3]> {
    let texture = bound.bindings.output(output).unwrap();
    let bytes = gpu.read_level(texture, array_layer, level, output).unwrap();
    channels(storage, &bytes)
}

struct Map {
    bound: Bound,
    depth: wgpu::Texture,
}

impl Map {
    fn new(gpu: &Gpu, text: &str, layers: u32, samples: u32) -> Self {
        let desc = TextureDesc {
            layers,
            samples,
            regions: 2,
            ..TextureDesc::new(TextureFormat::Depth32Float, MAP)
        };
        let plan = compiled(text, &capabilities(gpu), &[("light_depth", desc)]);
        let format = wgpu::TextureFormat::Depth32Float;
        let depth = depth_map::texture(gpu, format, MAP, layers, samples);
        for layer in 0..layers {
            depth_map::draw(gpu, &depth, layer, &depths(layer, samples));
        }
        let mut bytes = plan.parameters.initial();
        for layer in 0..layers {
            plan.parameters
                .write_regions(&mut bytes, "light_depth", layer, &REGIONS)
                .unwrap();
            plan.parameters
                .write_all(&mut bytes, "resolve", layer, &conversions())
                .unwrap();
        }
        let imports = [("light_depth", ImportedResource::from(&depth))];
        let bound = bind(gpu, plan, &imports, &bytes);
        Self { bound, depth }
    }
}

/// The channels of both planes for the mean over the samples of a texel.
fn encoded(basis: &Quantisation<6>, samples: &[f32], reversed: bool) -> [[f64; 3]; 2] {
    let mut mean = [0.0; 6];
    for &stored in samples {
        let forward = 2.0 * f64::from(stored) - 1.0;
        let z = if reversed { -forward } else { forward };
        for (power, mean) in (1..).zip(&mut mean) {
            *mean += z.powi(power) / samples.len() as f64;
        }
    }
    let channels = basis.encode(&mean);
    [0, 3].map(|first| [0, 1, 2].map(|index| channels[first + index]))
}

/// Every texel of a region, with its place in the map.
fn texels(region: &MapRegion) -> impl Iterator<Item = [usize; 2]> + use<> {
    let [left, top] = region.origin.map(|value| value as usize);
    let [columns, rows] = region.extent.map(|value| value as usize);
    (top..top + rows).flat_map(move |y| (left..left + columns).map(move |x| [x, y]))
}

pub(crate) fn opened() -> Gpu {
    Gpu::open(Profile::Native).unwrap()
}

#[test]
fn a_resolved_texel_is_the_nearest_to_the_mean_of_its_samples_in_every_storage() {
    let gpu = opened();
    let basis = six_moments();
    for &storage in Technique::Hamburger6.row().storages {
        let text = graph(storage, "\"kernel\": { \"radius\": 1 }", "downsample.map");
        for (layers, samples) in [(2, 1), (1, 4)] {
            let map = Map::new(&gpu, &text, layers, samples);
            map.bound.run(&gpu);
            let mut largest = 0.0_f64;
            for layer in 0..layers {
                let depths = depths(layer, samples);
                let planes = [0, 1]
                    .map(|plane| read(&gpu, &map.bound, storage, "resolved", 2 * layer + plane, 0));
                for (number, region) in REGIONS.iter().enumerate() {
                    for [x, y] in texels(region) {
                        let index = MAP[0] as usize * y + x;
                        let first = samples as usize * index;
                        let samples = &depths[first..first + samples as usize];
                        let expected = encoded(&basis, samples, number == 1);
                        for (plane, expected) in planes.iter().zip(expected) {
                            for (found, expected) in plane[index].iter().zip(expected) {
                                largest = largest.max((found - expected).abs());
                            }
                        }
                    }
                }
            }
            println!("{storage}, {samples} samples: off by {largest:.2e}");
            assert!(
                largest <= half_step(storage) + ARITHMETIC,
                "{storage}: {largest}"
            );
            // A step is a step: the map is no finer than its storage.
            if storage == Storage::Unorm10 {
                assert!(largest > 0.9 * half_step(storage));
            }
        }
    }
}

/// A filter along one axis within a region, in f64.
fn filtered(map: &[[f64; 3]], weights: &[f32], region: &MapRegion, axis: usize) -> Vec<[f64; 3]> {
    let mut result = map.to_vec();
    let low = region.origin[axis] as i64;
    let last = low + i64::from(region.extent[axis]) - 1;
    for place in texels(region) {
        let mut sum = [0.0; 3];
        for (tap, &weight) in (0_i64..).zip(weights) {
            let mut from = place;
            let offset = tap - weights.len() as i64 / 2;
            from[axis] = (place[axis] as i64 + offset).clamp(low, last) as usize;
            let texel = map[MAP[0] as usize * from[1] + from[0]];
            for (sum, channel) in sum.iter_mut().zip(texel) {
                *sum += f64::from(weight) * channel;
            }
        }
        result[MAP[0] as usize * place[1] + place[0]] = sum;
    }
    result
}

#[test]
fn a_blur_is_the_filter_of_each_plane_within_each_region_in_every_storage() {
    let gpu = opened();
    // Weights as literals, as parameters that begin as the kernel, and as those of a kernel too large for literals.
    for (kernel, radius) in [
        ("\"kernel\": { \"radius\": 3, \"sigma\": 1.3 }", RADIUS),
        (
            "\"kernel\": { \"radius\": 3, \"sigma\": 1.3 }, \"per_frame\": true",
            RADIUS,
        ),
        ("\"kernel\": { \"radius\": 12, \"sigma\": 1.3 }", 12),
    ] {
        let weights = Kernel::gaussian(radius, 1.3).unwrap();
        for &storage in Technique::Hamburger6.row().storages {
            let text = graph(storage, kernel, "downsample.map");
            let map = Map::new(&gpu, &text, 2, 1);
            map.bound.run(&gpu);
            let mut largest = 0.0_f64;
            for array_layer in 0..4 {
                let resolved = read(&gpu, &map.bound, storage, "resolved", array_layer, 0);
                let blurred = read(&gpu, &map.bound, storage, "map", array_layer, 0);
                for region in &REGIONS {
                    let along_x = filtered(&resolved, weights.weights(), region, 0);
                    let expected = filtered(&along_x, weights.weights(), region, 1);
                    for [x, y] in texels(region) {
                        let index = MAP[0] as usize * y + x;
                        for (found, expected) in blurred[index].iter().zip(expected[index]) {
                            largest = largest.max((found - expected).abs());
                        }
                    }
                }
            }
            println!("{storage}, radius {radius}: off by {largest:.2e}");
            // The second pass averages the roundings of the first, and rounds once more.
            assert!(
                largest <= 2.0 * half_step(storage) + ARITHMETIC,
                "{storage}: {largest}"
            );
        }
    }
}

#[test]
fn a_mip_level_is_the_mean_of_the_finer_one_in_each_plane_and_every_storage() {
    let gpu = opened();
    for &storage in Technique::Hamburger6.row().storages {
        let text = graph(storage, "\"kernel\": { \"radius\": 1 }", "downsample.map");
        let map = Map::new(&gpu, &text, 2, 1);
        map.bound.run(&gpu);
        let mut largest = 0.0_f64;
        for (array_layer, level) in (0..4).flat_map(|layer| [(layer, 1), (layer, 2)]) {
            let finer = read(&gpu, &map.bound, storage, "map", array_layer, level - 1);
            let coarser = read(&gpu, &map.bound, storage, "map", array_layer, level);
            let width = |level: u32| (MAP[0] >> level) as usize;
            for region in &REGIONS {
                let [from, to] = [level - 1, level].map(|level| at_level(region, level));
                let scale =
                    [0, 1].map(|axis| f64::from(from.extent[axis]) / f64::from(to.extent[axis]));
                for place in texels(&to) {
                    let begin: [f64; 2] = core::array::from_fn(|axis| {
                        (place[axis] as f64 - f64::from(to.origin[axis])) * scale[axis]
                    });
                    let mut sum = [0.0; 3];
                    for fine in texels(&from) {
                        let area: f64 = (0..2)
                            .map(|axis| {
                                let at = fine[axis] as f64 - f64::from(from.origin[axis]);
                                let end = begin[axis] + scale[axis];
                                ((at + 1.0).min(end) - at.max(begin[axis])).max(0.0) / scale[axis]
                            })
                            .product();
                        for (sum, channel) in sum
                            .iter_mut()
                            .zip(finer[width(level - 1) * fine[1] + fine[0]])
                        {
                            *sum += area * channel;
                        }
                    }
                    let found = coarser[width(level) * place[1] + place[0]];
                    for (found, sum) in found.iter().zip(sum) {
                        largest = largest.max((found - sum).abs());
                    }
                }
            }
        }
        println!("{storage}: off by {largest:.2e}");
        assert!(
            largest <= half_step(storage) + ARITHMETIC,
            "{storage}: {largest}"
        );
    }
}

#[test]
fn layers_and_texels_that_are_not_asked_for_keep_their_contents() {
    let gpu = opened();
    for &storage in Technique::Hamburger6.row().storages {
        let text = graph(storage, "\"kernel\": { \"radius\": 1 }", "downsample.map");
        let map = Map::new(&gpu, &text, 2, 1);
        map.bound.run(&gpu);
        let all = || -> Vec<Vec<u8>> {
            (0..4)
                .map(|layer| map.bound.read(&gpu, "map", layer))
                .collect()
        };
        let before = all();
        for layer in 0..2 {
            depth_map::draw(&gpu, &map.depth, layer, &depths(layer + 5, 1));
        }
        map.bound.run_layers(&gpu, Layers::Only(&[1]));
        let after = all();
        assert!(
            before[..2] == after[..2],
            "{storage}: a clean layer changed"
        );
        assert!(before[2] != after[2] && before[3] != after[3], "{storage}");
    }
}
