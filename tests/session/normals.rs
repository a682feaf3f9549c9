//! Normals say how a surface continues where depth would have to be compared with its neighbours'.

use glam::{Vec2, Vec3};
use moment_shadows::TextureFormat;
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::frame::Frame;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::graph_file::GraphFile;
use moment_shadows_lab::judgement::Truth;
use wgpu::util::DeviceExt as _;

use crate::stored::floor;
use crate::{HARD, frame, gpu, imports, places, recorded, session};

const SIZE: [u32; 2] = [320, 180];

/// Hard shadows of a filtered map.
fn filtered() -> String {
    let properties = r#""type": "shade_hard", "properties": { "format": "r32float" }"#;
    HARD.replace(r#""type": "shade_hard""#, properties)
}

/// The picture of a frame by a graph, with normals or without.
fn picture(gpu: &Gpu, text: &str, frame: &Frame, normals: Option<&wgpu::Texture>) -> Vec<f32> {
    let mut text = text.to_owned();
    let mut imports = imports(frame).to_vec();
    if let Some(normals) = normals {
        text = text
            .replacen(
                r#""imports": ["#,
                r#""imports": [ { "name": "normals" },"#,
                1,
            )
            .replace(
                r#""edges": ["#,
                r#""edges": [ { "from": "normals", "to": "shade.normals" },"#,
            );
        imports.push(("normals", ImportedResource::from(normals)));
    }
    let (camera, light) = places(frame);
    let mut session = session(gpu, &text, &imports);
    session.view(&gpu.queue, 0, &camera, &[light]).unwrap();
    bytemuck::pod_collect_to_vec(&recorded(gpu, &session, 0, "shadow_intensity"))
}

/// A texture of this size with given contents.
pub(crate) fn texture(
    gpu: &Gpu,
    format: TextureFormat,
    [width, height]: [u32; 2],
    bytes: &[u8],
) -> wgpu::Texture {
    let descriptor = wgpu::TextureDescriptor {
        label: Some("given"),
        size: wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: TextureDesc::new(format, [width, height]).wgpu_format(),
        usage: wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    };
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    (gpu.device).create_texture_with_data(&gpu.queue, &descriptor, order, bytes)
}

/// The octahedron that is folded open: what a shader has to undo.
fn octahedron(normal: Vec3) -> Vec2 {
    let flat = normal.truncate() / normal.abs().element_sum().max(1e-6);
    if normal.z >= 0.0 {
        return flat;
    }
    let turned = Vec2::ONE - Vec2::new(flat.y, flat.x).abs();
    turned * Vec2::new(1.0_f32.copysign(flat.x), 1.0_f32.copysign(flat.y))
}

fn mean_difference(a: &[f32], b: &[f32]) -> f64 {
    let differences = a.iter().zip(b).map(|(a, b)| f64::from((a - b).abs()));
    differences.sum::<f64>() / a.len() as f64
}

#[test]
fn a_floor_continues_where_its_normals_say() {
    let gpu = gpu();
    let format = wgpu::TextureFormat::Depth32Float;
    let frame = floor(&gpu, format, 1.0, false);
    // Taps far from the receiver are behind its plane or before it: a plane that leans another way is shadowed by itself.
    let text = r#"{ "version": 2, "imports": [{ "name": "light_depth" }, { "name": "camera_depth" }],
  "nodes": [{ "name": "shade", "type": "shade_hard",
              "properties": { "technique": { "pcf": { "box": { "radius": 12 } } }, "format": "r32float" } }],
  "edges": [{ "from": "light_depth", "to": "shade.depth" }, { "from": "camera_depth", "to": "shade.camera_depth" }],
  "outputs": [{ "name": "shadow_intensity", "from": "shade.shadow_intensity" }] }"#;
    let found = picture(&gpu, text, &frame, Some(&frame.surface.normal));
    let largest = found.into_iter().fold(0.0, f32::max);
    assert!(largest == 0.0, "{largest}");
}

#[test]
fn normals_bring_pictures_nearer_to_the_truth_in_every_encoding() {
    let gpu = gpu();
    let frame = frame(&gpu, 0, SIZE);
    let file = GraphFile::parse("graph", HARD.to_owned(), None).unwrap();
    let truth = Truth::of(&gpu, &frame, &file).unwrap();
    let from_depth = picture(&gpu, &filtered(), &frame, None);
    let from_normals = picture(&gpu, &filtered(), &frame, Some(&frame.surface.normal));
    let [depth, normals] = [&from_depth, &from_normals]
        .map(|found| truth.judge(found).unwrap().error.facing.mean_absolute);
    println!("off by {depth:.5} from depth, by {normals:.5} from normals");
    assert!(normals <= depth, "{normals} {depth}");
    assert!(mean_difference(&from_depth, &from_normals) > 0.0);

    let halves = gpu
        .read_texture(&frame.surface.normal, 0, "normals")
        .unwrap();
    let half =
        |texel: &[u8], at: usize| half::f16::from_le_bytes([texel[at], texel[at + 1]]).to_f32();
    let of = |texel: &[u8]| Vec3::from_array([0, 2, 4].map(|at| half(texel, at)));
    let all = || halves.chunks_exact(8).map(of);
    let unsigned = |value: f32, most: f32| (0.5 * most * (value + 1.0)).round() as u32;
    let packed = |normal: Vec3| {
        let [x, y, z] = normal.to_array().map(|value| unsigned(value, 1023.0));
        x | y << 10 | z << 20
    };
    let encodings: [(TextureFormat, Vec<u8>); 4] = [
        (
            TextureFormat::Rg32Float,
            all()
                .flat_map(|it| bytemuck::bytes_of(&octahedron(it).to_array()).to_vec())
                .collect(),
        ),
        (
            TextureFormat::Rg16Unorm,
            all()
                .flat_map(|it| {
                    octahedron(it)
                        .to_array()
                        .map(|value| unsigned(value, 65535.0) as u16)
                })
                .flat_map(u16::to_le_bytes)
                .collect(),
        ),
        (
            TextureFormat::Rgb10a2Unorm,
            all().flat_map(|it| packed(it).to_le_bytes()).collect(),
        ),
        (
            TextureFormat::Rgba32Float,
            all()
                .flat_map(|it| bytemuck::bytes_of(&(7.0 * it).extend(0.0).to_array()).to_vec())
                .collect(),
        ),
    ];
    for (format, bytes) in encodings {
        let found = picture(
            &gpu,
            &filtered(),
            &frame,
            Some(&texture(&gpu, format, SIZE, &bytes)),
        );
        let off = mean_difference(&found, &from_normals);
        println!("{format}: off by {off:.6}");
        assert!(off <= 1e-3, "{format}: {off}");
    }
}

#[test]
fn every_direction_comes_back_from_the_octahedron() {
    const SHADER: &str = "
import moment_shadows::shade::surface_plane::{surface_plane_normal};
alias BatchInput = vec2f;
alias BatchOutput = vec4f;
fn batch(input: BatchInput) -> BatchOutput {
    return vec4f(surface_plane_normal(vec3f(input, 0.0), true), 0.0);
}
";
    // Around the sphere in a spiral, and along its axes.
    let spiral = (0..4000).map(|index| {
        let z = 1.0 - (index as f32 + 0.5) / 2000.0;
        let (sin, cos) = (2.4 * index as f32).sin_cos();
        Vec3::new(cos, sin, 0.0) * (1.0 - z * z).sqrt() + z * Vec3::Z
    });
    let axes = [Vec3::X, Vec3::Y, Vec3::Z].into_iter();
    let directions: Vec<Vec3> = axes.flat_map(|axis| [axis, -axis]).chain(spiral).collect();
    let stored: Vec<[f32; 2]> = directions
        .iter()
        .map(|direction| octahedron(*direction).to_array())
        .collect();
    let gpu = gpu();
    let shader = Batch::new(&gpu, "octahedron.wgsl", SHADER).unwrap();
    let found: Vec<[f32; 4]> = shader.run(&stored).unwrap();
    for (direction, [x, y, z, _]) in directions.into_iter().zip(found) {
        let off = Vec3::new(x, y, z).distance(direction);
        assert!(off < 1e-5, "{direction}: off by {off}");
    }
}
