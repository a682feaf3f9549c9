//! Light depth in every format and with every number of samples, by every technique, is that of depth32float within the format's
//! own step.

use moment_shadows::{LightDepth, LightView, Technique, TextureFormat};
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_lab::command::drawn::Drawn;
use moment_shadows_lab::command::render::{LightChoice, RenderOptions};
use moment_shadows_lab::frame::Frame;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::scene;

use crate::normals::texture;
use crate::{HARD, gpu, imports, places, recorded, session};

const DRAWN: Drawn = Drawn {
    map: [128; 2],
    samples: 1,
    format: TextureFormat::Depth32Float,
    picture: [96, 54],
    camera_samples: 1,
    camera_format: TextureFormat::Depth32Float,
};

/// The picture of a frame by a technique, named in the graph file.
fn picture(gpu: &Gpu, frame: &Frame, technique: &Technique) -> Vec<f64> {
    let name = technique.name();
    let text = if technique.reads_depth() {
        format!(
            r#"{{ "version": 2, "imports": [{{ "name": "light_depth" }}, {{ "name": "camera_depth" }}],
  "nodes": [{{ "name": "shade", "type": "shade_hard", "properties": {{ "technique": "{name}" }} }}],
  "edges": [{{ "from": "light_depth", "to": "shade.depth" }}, {{ "from": "camera_depth", "to": "shade.camera_depth" }}],
  "outputs": [{{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }}] }}"#
        )
    } else {
        format!(
            r#"{{ "version": 2, "imports": [{{ "name": "light_depth" }}, {{ "name": "camera_depth" }}],
  "nodes": [{{ "name": "resolve", "type": "resolve", "properties": {{ "technique": "{name}" }} }},
            {{ "name": "blur", "type": "blur", "properties": {{ "kernel": {{ "radius": 3 }} }} }},
            {{ "name": "shade", "type": "shade_hard", "properties": {{ "technique": "{name}" }} }}],
  "edges": [{{ "from": "light_depth", "to": "resolve.depth" }}, {{ "from": "resolve.map", "to": "blur.map" }},
            {{ "from": "blur.blurred", "to": "shade.map" }}, {{ "from": "camera_depth", "to": "shade.camera_depth" }}],
  "outputs": [{{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }}] }}"#
        )
    };
    let (camera, light) = places(frame);
    let mut session = session(gpu, &text, &imports(frame));
    session.view(&gpu.queue, 0, &camera, &[light]).unwrap();
    let bytes = recorded(gpu, &session, 0, "shadow_intensity");
    bytes.iter().map(|&byte| f64::from(byte) / 255.0).collect()
}

/// The hall, its light's depth stored in a format.
fn frame(gpu: &Gpu, format: TextureFormat, samples: u32, reversed: bool) -> Frame {
    let options = RenderOptions {
        reversed,
        ..Default::default()
    };
    let drawn = Drawn {
        samples,
        format,
        ..DRAWN
    };
    let scene = scene::load("hall").unwrap();
    options.frame(gpu, &scene, &drawn, 4).unwrap()
}

fn mean_difference(a: &[f64], b: &[f64]) -> f64 {
    let differences = a.iter().zip(b).map(|(a, b)| (a - b).abs());
    differences.sum::<f64>() / a.len() as f64
}

#[test]
fn every_depth_format_of_a_light_gives_what_depth32float_gives() {
    let gpu = gpu();
    let mut names: Vec<Technique> = Technique::examples();
    names.dedup_by_key(|technique| technique.name());
    let formats = TextureFormat::ALL
        .into_iter()
        .filter(|format| format.is_depth());
    let formats: Vec<TextureFormat> = formats.collect();
    for reversed in [false, true] {
        for samples in [1, 4] {
            let frames = formats
                .iter()
                .map(|format| frame(&gpu, *format, samples, reversed));
            let frames: Vec<Frame> = frames.collect();
            let reference = frame(&gpu, TextureFormat::Depth32Float, samples, reversed);
            for technique in &names {
                if technique.reads_depth() && samples > 1 {
                    continue;
                }
                let expected = picture(&gpu, &reference, technique);
                for (format, frame) in formats.iter().zip(&frames) {
                    let off = mean_difference(&picture(&gpu, frame, technique), &expected);
                    println!(
                        "{technique}, {format}, {samples} samples, reversed {reversed}: {off:.5}"
                    );
                    let step = format.depth_step().unwrap();
                    // Storage rounds what differs by as little as it may.
                    assert!(off <= 1e-4 + 60.0 * step, "{technique}, {format}: {off}");
                }
            }
        }
    }
}

#[test]
fn distances_in_r32float_give_what_perspective_depth_gives() {
    let gpu = gpu();
    let options = RenderOptions {
        light: LightChoice::Spot,
        ..Default::default()
    };
    let frame = options
        .frame(&gpu, &scene::load("hall").unwrap(), &DRAWN, 4)
        .unwrap();
    let (camera, light) = places(&frame);
    let stored = gpu
        .read_texture(&frame.light_map.texture, 0, "depth")
        .unwrap();
    let stored: Vec<f32> = bytemuck::pod_collect_to_vec(&stored);
    let distance = |&depth: &f32| frame.desc.light.depth.distance(f64::from(depth)) as f32;
    let distances: Vec<f32> = stored.iter().map(distance).collect();
    let LightDepth::Perspective { range, .. } = light.depth else {
        panic!("the light is a spot");
    };
    let map = texture(
        &gpu,
        TextureFormat::R32Float,
        frame.desc.map,
        bytemuck::cast_slice(&distances),
    );
    let linear = LightView {
        depth: LightDepth::Linear { range },
        ..light
    };
    let [mut of_depth, mut of_distance] = [imports(&frame), imports(&frame)];
    of_depth[0].1 = ImportedResource::from(&frame.light_map.texture);
    of_distance[0].1 = ImportedResource::from(&map);
    let [expected, found] = [(of_depth, light), (of_distance, linear)].map(|(imports, light)| {
        let mut session = session(&gpu, HARD, &imports);
        session.view(&gpu.queue, 0, &camera, &[light]).unwrap();
        let bytes = recorded(&gpu, &session, 0, "shadow_intensity");
        bytes
            .iter()
            .map(|&byte| f64::from(byte) / 255.0)
            .collect::<Vec<_>>()
    });
    let off = mean_difference(&found, &expected);
    let mean = expected.iter().sum::<f64>() / expected.len() as f64;
    println!("off by {off:.6}, {mean:.3} in the mean");
    assert!(off < 1e-4, "{off}");
    assert!((0.1..0.9).contains(&mean), "{mean}");
    // A sun has no distances.
    let sun = LightView {
        depth: LightDepth::Linear { range },
        ..LightView::orthographic(glam::DMat4::IDENTITY.to_cols_array_2d())
    };
    let mut session = session(&gpu, HARD, &imports(&frame));
    let error = session.view(&gpu.queue, 0, &camera, &[sun]).unwrap_err();
    assert!(error.to_string().contains("parallel rays"), "{error}");
}
