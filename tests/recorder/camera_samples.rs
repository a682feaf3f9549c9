//! The camera's depth in every format and with several samples: the first sample of a pixel is shaded, where it lies.

use glam::{DMat4, DVec3};
use moment_shadows::{TextureFormat, ViewParameters};
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::host::read_depth_samples;

use crate::depth_map;
use crate::setup::{IDENTITY, bind, block, capabilities, compiled, view};

const SIDE: u32 = 24;

const GRAPH: &str = r#"{ "version": 2, "imports": [{ "name": "light_depth" }, { "name": "camera_depth" }],
  "nodes": [{ "name": "resolve", "type": "resolve", "properties": { "storage": "float32" } },
            { "name": "shade", "type": "shade_hard", "properties": { "format": "r32float" } }],
  "edges": [{ "from": "light_depth", "to": "resolve.depth" }, { "from": "resolve.map", "to": "shade.map" },
            { "from": "camera_depth", "to": "shade.camera_depth" }],
  "outputs": [{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }] }"#;

/// A triangle over the whole picture whose depth is `depth` of its place there, from 0 to 1 along both axes.
const PLANE: &str = "
@vertex fn triangle(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let place = 2.0 * vec2f(f32(index & 1u), f32(index >> 1u));
    return vec4f(vec2f(2.0, -2.0) * place + vec2f(-1.0, 1.0), DEPTH, 1.0);
}";

/// The plane, as a function of x and y from 0 to 1.
fn plane(x: f64, y: f64) -> f64 {
    0.5 + 0.3 * x + 0.15 * y
}

/// What the rasteriser makes of the plane.
fn rasterised(gpu: &Gpu, format: wgpu::TextureFormat, samples: u32) -> wgpu::Texture {
    let camera = depth_map::texture(gpu, format, [SIDE; 2], 1, samples);
    let text = PLANE.replace("DEPTH", "0.5 + 0.3 * place.x + 0.15 * place.y");
    depth_map::draw_by(gpu, &camera, &text);
    camera
}

fn picture(
    gpu: &Gpu,
    camera: &wgpu::Texture,
    format: TextureFormat,
    view: &ViewParameters,
) -> Vec<f32> {
    // Of every second column a step behind the plane, and none before it.
    let map = depth_map::of(gpu, [SIDE; 2], |x, y| {
        let [u, v] = [x, y].map(|at| (f64::from(at) + 0.5) / f64::from(SIDE));
        let nearer = [0.0, 0.05, 0.1][(x / 2 % 3) as usize];
        (plane(u, v) - nearer) as f32
    });
    let light_desc = TextureDesc::new(TextureFormat::Depth32Float, [SIDE; 2]);
    let camera_desc = TextureDesc {
        samples: camera.sample_count(),
        ..TextureDesc::new(format, [SIDE; 2])
    };
    let descs = [("light_depth", light_desc), ("camera_depth", camera_desc)];
    let plan = compiled(GRAPH, &capabilities(gpu), &descs);
    let bytes = block(&plan, view);
    let imports = [
        ("light_depth", ImportedResource::from(&map)),
        ("camera_depth", ImportedResource::from(camera)),
    ];
    let bound = bind(gpu, plan, &imports, &bytes);
    bound.run(gpu);
    bound.read_floats(gpu, "shadow_intensity", 0)
}

/// Where in a pixel the adapter's rasteriser has the depth of the first sample, found by a plane along each axis.
fn place_of_depth(gpu: &Gpu, samples: u32) -> [f64; 2] {
    ["x", "y"].map(|axis| {
        let format = wgpu::TextureFormat::Depth32Float;
        let camera = depth_map::texture(gpu, format, [SIDE; 2], 1, samples);
        let text = PLANE.replace("DEPTH", &format!("0.4 * place.{axis}"));
        depth_map::draw_by(gpu, &camera, &text);
        let read = read_depth_samples(gpu, &camera).unwrap();
        f64::from(read.values[0]) / 0.4 * f64::from(SIDE)
    })
}

#[test]
fn every_format_and_number_of_samples_is_shaded_where_its_first_sample_lies() {
    let gpu = Gpu::open(moment_shadows::Profile::NativeAdapter).unwrap();
    // Where the standard patterns have their first sample (Vulkan specification, "Standard sample locations").
    let places = [
        (1, [0.5, 0.5]),
        (2, [0.75, 0.75]),
        (4, [0.375, 0.125]),
        (8, [0.5625, 0.3125]),
    ];
    for (samples, place) in places {
        let format = wgpu::TextureFormat::Depth32Float;
        let flags = gpu.adapter.get_texture_format_features(format).flags;
        if !flags.sample_count_supported(samples) {
            println!("{samples} samples: not on this adapter");
            continue;
        }
        // SwiftShader has the depth of places that lie the other way round from left to right (`findings`).
        let found = place_of_depth(&gpu, samples);
        let mirrored = gpu.adapter.get_info().name.starts_with("SwiftShader");
        let has_depth = match mirrored && samples > 1 {
            true => [1.0 - place[0], place[1]],
            false => place,
        };
        let off = [0, 1].map(|axis| (found[axis] - has_depth[axis]).abs());
        assert!(off[0].max(off[1]) < 1e-3, "{samples} samples: {found:?}");
        let offset = place.map(|at| (at - 0.5) / f64::from(SIDE));
        let at = |index: u32, axis: usize| (f64::from(index) + has_depth[axis]) / f64::from(SIDE);
        // One sample in the middle of the pixel, of a camera that is moved instead.
        let values = |x, y| plane(at(x, 0), at(y, 1)) as f32;
        let single = depth_map::of(&gpu, [SIDE; 2], values);
        let moved = DMat4::from_translation(DVec3::new(-2.0 * offset[0], 2.0 * offset[1], 0.0));
        let moved = view(moved.to_cols_array_2d(), IDENTITY, 0);
        let expected = picture(&gpu, &single, TextureFormat::Depth32Float, &moved);
        let range = expected.iter().fold([1.0_f32, 0.0], |[low, high], &it| {
            [low.min(it), high.max(it)]
        });
        assert!(range[0] < 0.2 && range[1] > 0.8, "{range:?}");
        for format in TextureFormat::ALL
            .into_iter()
            .filter(|format| format.is_depth())
        {
            let wgpu_format = TextureDesc::new(format, [1, 1]).wgpu_format();
            let flags = gpu.adapter.get_texture_format_features(wgpu_format).flags;
            if !flags.sample_count_supported(samples) {
                println!("{format}, {samples} samples: not on this adapter");
                continue;
            }
            let camera = rasterised(&gpu, wgpu_format, samples);
            let found = picture(&gpu, &camera, format, &view(IDENTITY, IDENTITY, 0));
            let worst = found
                .iter()
                .zip(&expected)
                .map(|(a, b)| (a - b).abs())
                .fold(0.0, f32::max);
            println!("{format}, {samples} samples: off by {worst:.1e}");
            // A bound falls from 1 to 0 over a few hundredths of depth behind a surface; a step of depth is this part of that.
            let step = format.depth_step().unwrap() as f32;
            assert!(
                worst <= 200.0 * step + 2e-3,
                "{format}, {samples} samples: {worst}"
            );
        }
    }
}
