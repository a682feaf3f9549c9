//! `resolve` against moments in f64, for every way in which a host stores depth.

use moment_shadows::{DepthConversion, DepthRange, Profile, TextureFormat};
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_lab::gpu::Gpu;

use crate::depth_map;
use crate::setup::{Bound, bind, capabilities, compiled};

const SIZE: [u32; 2] = [13, 11];

const GRAPH: &str = r#"{ "version": 2, "imports": [{ "name": "depth" }],
  "nodes": [{ "name": "resolve", "type": "resolve", "properties": { "storage": "float32" } }],
  "edges": [{ "from": "depth", "to": "resolve.depth" }],
  "outputs": [{ "name": "map", "from": "resolve.map" }] }"#;

fn bound(gpu: &Gpu, map: &wgpu::Texture, conversion: &DepthConversion) -> Bound {
    let format = match map.format() {
        wgpu::TextureFormat::Depth16Unorm => TextureFormat::Depth16Unorm,
        _ => TextureFormat::Depth32Float,
    };
    let desc = TextureDesc {
        samples: map.sample_count(),
        ..TextureDesc::new(format, SIZE)
    };
    let plan = compiled(GRAPH, &capabilities(gpu), &[("depth", desc)]);
    let mut bytes = plan.parameters.initial();
    plan.parameters
        .write(&mut bytes, "resolve", 0, conversion)
        .unwrap();
    let bound = bind(gpu, plan, &[("depth", ImportedResource::from(map))], &bytes);
    bound.run(gpu);
    bound
}

/// Depths that cover [0, 1] with both ends; multiples of 1 / 65535, which 16 bits hold exactly.
fn depths(samples: u32) -> Vec<f32> {
    let count = SIZE[0] * SIZE[1] * samples;
    (0..count)
        .map(|index| {
            let step = (u64::from(index) * 40_503 % 65_536) as f64;
            let step = match index {
                0 => 0.0,
                1 => 65_535.0,
                _ => step,
            };
            (step / 65_535.0) as f32
        })
        .collect()
}

/// Asserts the moments of every texel: means over the samples of the powers of moment depth.
fn assert_moments(
    gpu: &Gpu,
    format: wgpu::TextureFormat,
    samples: u32,
    conversion: &DepthConversion,
    moment_depth: impl Fn(f64) -> f64,
    what: &str,
) {
    let map = depth_map::texture(gpu, format, SIZE, 1, samples);
    let stored = depths(samples);
    depth_map::draw(gpu, &map, 0, &stored);
    let moments = bound(gpu, &map, conversion).read_floats(gpu, "map", 0);
    for (texel, found) in moments.chunks_exact(4).enumerate() {
        let first = texel * samples as usize;
        for (power, &found) in (1..).zip(found) {
            let mean = stored[first..first + samples as usize]
                .iter()
                .map(|&depth| moment_depth(f64::from(depth)).clamp(-1.0, 1.0).powi(power))
                .sum::<f64>()
                / f64::from(samples);
            // A few roundings of 2^-24 in the conversion, whose weights are below 2, times the fourth power's slope of 4.
            let error = (f64::from(found) - mean).abs();
            assert!(
                error < 2e-6,
                "{what}, {samples} samples, texel {texel}, moment {power}: {found} instead of {mean}"
            );
        }
    }
}

#[test]
fn orthographic_depth() {
    let gpu = crate::setup::gpu();
    for format in [
        wgpu::TextureFormat::Depth32Float,
        wgpu::TextureFormat::Depth16Unorm,
    ] {
        for samples in [1, 4] {
            let forward = DepthConversion::orthographic();
            assert_moments(
                &gpu,
                format,
                samples,
                &forward,
                |d| 2.0 * d - 1.0,
                "forward",
            );
            let reversed = DepthConversion::orthographic().reversed();
            assert_moments(
                &gpu,
                format,
                samples,
                &reversed,
                |d| 1.0 - 2.0 * d,
                "reversed",
            );
        }
    }
}

/// A conversion, what it stands for, and its name.
type Case<'a> = (DepthConversion, &'a dyn Fn(f64) -> f64, &'a str);

#[test]
fn perspective_depth() {
    let gpu = crate::setup::gpu();
    let format = wgpu::TextureFormat::Depth32Float;
    let (near, far) = (0.5, 60.0);
    let range = DepthRange {
        near: 0.5,
        far: 50.0,
    };
    let moment_depth =
        |distance: f64| 2.0 * (distance - range.near) / (range.far - range.near) - 1.0;
    let finite = |d: f64| moment_depth(near * far / (far - d * (far - near)));
    let infinite = |d: f64| moment_depth(near / (1.0 - d));
    for samples in [1, 4] {
        let cases: [Case<'_>; 4] = [
            (
                DepthConversion::perspective(near, far, range).unwrap(),
                &finite,
                "finite",
            ),
            (
                DepthConversion::perspective(near, far, range)
                    .unwrap()
                    .reversed(),
                &|d| finite(1.0 - d),
                "finite reversed",
            ),
            (
                DepthConversion::perspective(near, f64::INFINITY, range).unwrap(),
                &infinite,
                "infinite",
            ),
            (
                DepthConversion::perspective(near, f64::INFINITY, range)
                    .unwrap()
                    .reversed(),
                &|d| infinite(1.0 - d),
                "infinite reversed",
            ),
        ];
        for (conversion, reference, what) in cases {
            assert_moments(&gpu, format, samples, &conversion, reference, what);
        }
    }
}

#[test]
fn samples_of_the_adapters_own_counts() {
    let Ok(gpu) = Gpu::open(Profile::NativeAdapter) else {
        // The adapter has no features of its own, and with them no further sample counts.
        return;
    };
    let counts = capabilities(&gpu).depth_samples;
    for samples in [2, 8]
        .into_iter()
        .filter(|samples| counts.contains(samples))
    {
        let forward = DepthConversion::orthographic();
        let format = wgpu::TextureFormat::Depth32Float;
        assert_moments(
            &gpu,
            format,
            samples,
            &forward,
            |d| 2.0 * d - 1.0,
            "forward",
        );
    }
}

#[test]
fn what_no_caster_covers_holds_the_far_end() {
    let gpu = crate::setup::gpu();
    let range = DepthRange {
        near: 1.0,
        far: 20.0,
    };
    let cases = [
        (1.0, DepthConversion::orthographic()),
        (0.0, DepthConversion::orthographic().reversed()),
        (1.0, DepthConversion::perspective(1.0, 20.0, range).unwrap()),
        (
            0.0,
            DepthConversion::perspective(1.0, f64::INFINITY, range)
                .unwrap()
                .reversed(),
        ),
        (
            1.0,
            DepthConversion::perspective(1.0, f64::INFINITY, range).unwrap(),
        ),
    ];
    for (cleared, conversion) in cases {
        for samples in [1, 4] {
            let format = wgpu::TextureFormat::Depth32Float;
            let map = depth_map::texture(&gpu, format, SIZE, 1, samples);
            depth_map::clear(&gpu, &map, 0, cleared);
            let moments = bound(&gpu, &map, &conversion).read_floats(&gpu, "map", 0);
            assert_eq!(moments.len(), (SIZE[0] * SIZE[1] * 4) as usize);
            assert!(
                moments.iter().all(|&moment| moment == 1.0),
                "{conversion:?}: {:?}",
                &moments[..4]
            );
        }
    }
}
