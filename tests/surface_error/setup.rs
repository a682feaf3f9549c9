//! Graphs, scenes and subjects to measure.

use std::path::Path;

use moment_shadows::Storage;
use moment_shadows_lab::command::drawn::Drawn;
use moment_shadows_lab::command::error::ErrorSubject;
use moment_shadows_lab::command::error_table;
use moment_shadows_lab::command::render::{RenderOptions, profile_for};
use moment_shadows_lab::frame::Frame;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::graph_file::GraphFile;
use moment_shadows_lab::scene::{Material, Mesh, Scene};

/// The example of hard shadows with another storage and radius.
pub(crate) fn graph(storage: Storage, radius: u32) -> GraphFile {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/hard_shadows.json");
    GraphFile::read(&path, Some(storage))
        .unwrap()
        .with_radius(radius)
        .unwrap()
}

/// A map of `map` texels squared with `samples` each, and a small picture.
pub(crate) fn options(map: u32, samples: u32) -> RenderOptions {
    RenderOptions {
        size: Some([320, 180]),
        map: Some(map),
        samples: Some(samples),
        ..RenderOptions::default()
    }
}

/// The frame of a scene with so many texels per side and samples per texel, for a kernel of this radius.
pub(crate) fn frame(gpu: &Gpu, scene: &Scene, (map, samples): (u32, u32), margin: u32) -> Frame {
    let drawn = Drawn {
        picture: [320, 180],
        map: [map; 2],
        samples,
        ..Drawn::default()
    };
    let options = RenderOptions::default();
    options.frame(gpu, scene, &drawn, margin).unwrap()
}

/// A table of a graph.
pub(crate) fn table_options(
    graph: &Path,
    frame: RenderOptions,
    scene: Vec<String>,
    radii: &[u32],
    stride: u32,
) -> error_table::Options {
    error_table::Options {
        frame,
        scene,
        graph: graph.to_owned(),
        radius: radii.to_vec(),
        technique: Vec::new(),
        all: false,
        stride,
        out: None,
        json: false,
    }
}

pub(crate) fn open() -> Gpu {
    Gpu::open(profile_for(None, 4)).unwrap()
}

/// A scene for a kernel of `radius`.
pub(crate) fn subject(
    gpu: &Gpu,
    scene: &Scene,
    options: &RenderOptions,
    radius: u32,
) -> ErrorSubject {
    let file = graph(Storage::Float32, radius);
    let drawn = options.drawn(&file).unwrap();
    ErrorSubject::new(gpu, scene, (options, &drawn), &file, || ()).unwrap()
}

/// SplitMix64: numbers in [0, 1) that are the same everywhere.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// An opaque mesh of separate triangles.
pub(crate) fn soup(triangles: &[[[f32; 3]; 3]]) -> Mesh {
    let positions = triangles.as_flattened().to_vec();
    Mesh {
        normals: vec![[0.0; 3]; positions.len()],
        uvs: vec![[0.0; 2]; positions.len()],
        indices: (0..positions.len() as u32).collect(),
        positions,
        ..Mesh::default()
    }
}

/// A horizontal square of half edge `half` about the origin, at a height.
pub(crate) fn plate(half: f32, height: f32) -> Mesh {
    let [a, b, c, d] = [
        [-half, height, -half],
        [-half, height, half],
        [half, height, half],
        [half, height, -half],
    ];
    let mut mesh = soup(&[[a, b, c], [a, c, d]]);
    let uv = |[x, _, z]: &[f32; 3]| [0.5 + 0.5 * x / half, 0.5 + 0.5 * z / half];
    mesh.uvs = mesh.positions.iter().map(uv).collect();
    mesh
}

pub(crate) fn scene(meshes: Vec<Mesh>) -> Scene {
    Scene {
        name: "test".to_owned(),
        meshes,
        materials: vec![Material::plain("grey", [0.5; 3])],
        ..Scene::default()
    }
}
