//! Prefix sums along rows against f64, by either shader.

use bytemuck::bytes_of;
use glam::DVec3;
use moment_shadows::{
    IntegrateScatteringParameters, MapEncoding, RectifiedFrame, RectifiedView, Storage, Technique,
};
use moment_shadows_graph::Capabilities;
use moment_shadows_lab::batch::Batch;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::cameras::{Lens, looking, pair};
use crate::stage::{capabilities, gpu, run, upload, upload_words};

const GRAPH: &str = r#"{
  "version": 2,
  "imports": [{ "name": "map" }],
  "nodes": [{ "name": "integrate", "type": "integrate_scattering" }],
  "edges": [{ "from": "map", "to": "integrate.rectified" }],
  "outputs": [{ "name": "integrated", "from": "integrate.integrated" }]
}"#;

/// With the view rays that end in each texel.
const SEEN: &str = r#"{
  "version": 2,
  "imports": [{ "name": "map" }, { "name": "view_rays" }],
  "nodes": [{ "name": "integrate", "type": "integrate_scattering" }],
  "edges": [
    { "from": "map", "to": "integrate.rectified" },
    { "from": "view_rays", "to": "integrate.view_rays" }
  ],
  "outputs": [{ "name": "integrated", "from": "integrate.integrated" }]
}"#;

/// One more than twice what a workgroup sums up at a time, and rows of less than a workgroup's.
const SIZE: [u32; 2] = [1025, 67];

fn frame() -> RectifiedFrame {
    let lens = Lens {
        field_of_view: 1.2,
        aspect: 1.5,
        near: 0.1,
        far: None,
    };
    let pair = pair(
        DVec3::ZERO,
        looking(DVec3::new(0.3, -0.2, 1.0), 0.0),
        lens,
        50.0,
        DVec3::new(0.5, -1.0, 0.2),
    );
    RectifiedView::new(&pair.clip_from_world, pair.far, pair.light)
        .unwrap()
        .frame
}

/// The optical thickness of a column of each row, as the shader has it; another test compares it with brute force.
fn thicknesses(frame: RectifiedFrame, extinction: f32) -> Vec<f64> {
    let gpu = gpu();
    let shader = format!(
        "
import moment_shadows::air::rectified_frame::{{RectifiedFrame, rectified_frame_ray}};
import moment_shadows::air::scattering_weights::{{scattering_weights_thickness}};
struct BatchInput {{ frame: RectifiedFrame, row: f32, extinction: f32, padding: vec2f }}
alias BatchOutput = f32;
fn batch(input: BatchInput) -> BatchOutput {{
    let azimuth = rectified_frame_ray(input.frame, vec2f(0.0, input.row)).y;
    return scattering_weights_thickness(input.frame, azimuth, input.extinction, {}.0);
}}
",
        SIZE[0]
    );
    let inputs: Vec<[f32; 24]> = (0..SIZE[1])
        .map(|row| {
            let mut input = [0.0; 24];
            input[..20].copy_from_slice(bytemuck::cast_slice(&[frame]));
            input[20] = row as f32 / (SIZE[1] - 1) as f32;
            input[21] = extinction;
            input
        })
        .collect();
    let found: Vec<f32> = Batch::new(&gpu, "thickness.wgsl", &shader)
        .unwrap()
        .run(&inputs)
        .unwrap();
    found.into_iter().map(f64::from).collect()
}

/// The values of a layer's texels.
fn values(bytes: &[u8], encoding: &MapEncoding) -> Vec<f64> {
    match encoding.storage() {
        Storage::Float32 => bytes
            .chunks_exact(4)
            .map(|value| f64::from(f32::from_le_bytes(value.try_into().unwrap())))
            .collect(),
        Storage::Float16 => bytes
            .chunks_exact(2)
            .map(|value| half::f16::from_le_bytes(value.try_into().unwrap()).to_f64())
            .collect(),
        Storage::Unorm8 => bytes.iter().map(|&it| f64::from(it) / 255.0).collect(),
        _ => bytes
            .chunks_exact(2)
            .map(|value| f64::from(u16::from_le_bytes(value.try_into().unwrap())) / 65535.0)
            .collect(),
    }
}

#[test]
fn prefix_sums_are_exact_within_the_rounding_of_their_storage() {
    let gpu = gpu();
    let frame = frame();
    let mut random = ChaCha8Rng::seed_from_u64(64);
    let native = capabilities(&gpu);
    // Half a unit in the last place of each storage below 1, and the roundings of a thousand sums in f32.
    let cases = [
        (Technique::Hamburger4, Storage::Float16, 2.5e-4),
        (Technique::Hamburger6, Storage::Float16, 2.5e-4),
        (Technique::Hamburger4, Storage::Unorm16, 9.6e-6),
        (Technique::Hamburger4, Storage::Float32, 4e-6),
        (Technique::Hamburger6, Storage::Unorm8, 1.97e-3),
    ];
    for (technique, storage, tolerance) in cases {
        let encoding = MapEncoding::rectified(technique, storage).unwrap();
        let texels = (SIZE[0] * SIZE[1] * encoding.planes()) as usize;
        let low = if matches!(storage, Storage::Unorm16 | Storage::Unorm8) {
            0.0
        } else {
            -0.5
        };
        let channels: Vec<[f32; 4]> = (0..texels)
            .map(|_| [0; 4].map(|_| random.random_range(low..low + 1.0)))
            .collect();
        let map = upload(&gpu, &encoding, SIZE, &channels);
        let stored = |value: f32| match storage {
            Storage::Float16 => half::f16::from_f32(value).to_f64(),
            Storage::Unorm16 => f64::from((value * 65535.0).round()) / 65535.0,
            Storage::Unorm8 => f64::from((value * 255.0).round()) / 255.0,
            _ => f64::from(value),
        };
        for extinction in [0.0, 0.003, 0.1, 30.0] {
            let parameters = IntegrateScatteringParameters {
                frame,
                extinction,
                padding: [0.0; 3],
            };
            let thicknesses = thicknesses(frame, extinction);
            for software_adapter in [true, false] {
                let capabilities = Capabilities {
                    software_adapter,
                    ..native.clone()
                };
                let layers = run(
                    &gpu,
                    &capabilities,
                    GRAPH,
                    &[("map", &map)],
                    &[("integrate", bytes_of(&parameters))],
                    "integrated",
                );
                let found: Vec<f64> = layers
                    .iter()
                    .flat_map(|layer| values(layer, &encoding))
                    .collect();
                let mut largest: f64 = 0.0;
                for (row, texels) in channels.chunks(SIZE[0] as usize).enumerate() {
                    let thickness = thicknesses[row % SIZE[1] as usize];
                    let (mut sum, mut weight) = ([0.0; 4], 0.0);
                    for (column, texel) in texels.iter().enumerate() {
                        let of_column = (-thickness * column as f64).exp();
                        weight += of_column;
                        for channel in 0..4 {
                            sum[channel] += of_column * stored(texel[channel]);
                            let place = (row * SIZE[0] as usize + column) * 4 + channel;
                            let error = (found[place] - sum[channel] / weight).abs();
                            largest = largest.max(error);
                        }
                    }
                }
                println!(
                    "{encoding}, extinction {extinction}, serial {software_adapter}: {largest:.1e}"
                );
                assert!(
                    largest <= tolerance,
                    "{encoding} {extinction} {software_adapter}: {largest}"
                );
            }
        }
    }
}

/// The mean of the sines that are known in a column of nine rows, of which the middle one counts five times.
fn sine_about(sines: &[f32], row: usize, column: usize) -> f64 {
    let [columns, rows] = SIZE.map(|side| side as usize);
    let mut known = Vec::new();
    for (weight, offset) in [1, 2, 3, 4, 5, 4, 3, 2, 1].into_iter().zip(0..) {
        let other = (row + offset).saturating_sub(4).min(rows - 1);
        let sine = sines[other * columns + column];
        known.extend((sine > 0.0).then_some((f64::from(weight), f64::from(sine))));
    }
    let sum: f64 = known.iter().map(|(weight, sine)| weight * sine).sum();
    let weights: f64 = known.iter().map(|it| it.0).sum();
    if weights > 0.0 { sum / weights } else { 0.0 }
}

#[test]
fn sums_have_the_weights_of_the_view_rays_that_end_there() {
    let gpu = gpu();
    let frame = frame();
    let mut random = ChaCha8Rng::seed_from_u64(65);
    let native = capabilities(&gpu);
    let encoding = MapEncoding::new(Technique::Hamburger4, Storage::Float32).unwrap();
    let texels = (SIZE[0] * SIZE[1]) as usize;
    let channels: Vec<[f32; 4]> = (0..texels)
        .map(|_| [0; 4].map(|_| random.random_range(-0.5..0.5)))
        .collect();
    let map = upload(&gpu, &encoding, SIZE, &channels);
    // Of one in five nothing is known.
    let sines: Vec<f32> = (0..texels)
        .map(|_| random.random_range(-0.25_f32..1.0).max(0.0))
        .collect();
    let words: Vec<u8> = (sines.iter())
        .flat_map(|sine| [0xffff_0000, sine.to_bits()])
        .flat_map(u32::to_le_bytes)
        .collect();
    let rays = upload_words(&gpu, SIZE, &words);
    for extinction in [0.0, 0.003, 0.03, 30.0] {
        let parameters = IntegrateScatteringParameters {
            frame,
            extinction,
            padding: [0.0; 3],
        };
        let thicknesses = thicknesses(frame, extinction);
        for software_adapter in [true, false] {
            let capabilities = Capabilities {
                software_adapter,
                ..native.clone()
            };
            let layers = run(
                &gpu,
                &capabilities,
                SEEN,
                &[("map", &map), ("view_rays", &rays)],
                &[("integrate", bytes_of(&parameters))],
                "integrated",
            );
            let found = values(&layers[0], &encoding);
            let mut largest = 0.0_f64;
            let columns = SIZE[0] as usize;
            for (row, texels) in channels.chunks(columns).enumerate() {
                let thickness = thicknesses[row];
                // Some columns: each is a sum of its own.
                for column in (0..columns).step_by(37) {
                    let sine = sine_about(&sines, row, column);
                    let end = column as f64 + 1.5;
                    let own = f64::from(extinction) * f64::from(frame.largest_radius)
                        / f64::from(SIZE[0])
                        / sine;
                    let tilt = if sine > 0.0 {
                        ((own - thickness) * end).clamp(-2.0, 2.0)
                    } else {
                        0.0
                    };
                    let (mut sum, mut weight) = ([0.0; 4], 0.0);
                    for (before, texel) in texels[..=column].iter().enumerate() {
                        let line = 1.0 + tilt * (0.5 - (before as f64 + 0.5) / end);
                        let of_column = line * (-thickness * before as f64).exp();
                        weight += of_column;
                        for channel in 0..4 {
                            sum[channel] += of_column * f64::from(texel[channel]);
                        }
                    }
                    let place = (row * columns + column) * 4;
                    for (found, sum) in found[place..place + 4].iter().zip(sum) {
                        largest = largest.max((found - sum / weight).abs());
                    }
                }
            }
            println!("extinction {extinction}, serial {software_adapter}: {largest:.1e}");
            // The roundings of a thousand sums in f32, twice.
            assert!(
                largest <= 8e-6,
                "{extinction} {software_adapter}: {largest}"
            );
        }
    }
}
