//! The short path gives what the five objects give, for any number of cameras, and says what does not suit it.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

mod cameras;
mod contacts;
mod debug;
mod far;
mod fitted;
mod formats;
mod found;
mod frames;
mod many;
mod marched;
mod normals;
mod off;
mod orders;
mod refused;
mod same;
mod seen;
mod soak;
mod steady;
mod stored;
mod translucent;
mod views;
mod widths;

use moment_shadows::{CameraView, LightView, Profile};
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_graph::{Graph, NodeRegistry, Session, Stage};
use moment_shadows_lab::command::drawn::Drawn;
use moment_shadows_lab::command::render::RenderOptions;
use moment_shadows_lab::frame::Frame;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::graph_frame::{camera_view, light_view};
use moment_shadows_lab::scene;
use pollster::block_on;

pub(crate) const HARD: &str = include_str!("../../examples/hard_shadows.json");
pub(crate) const FITTED: &str = include_str!("../../examples/fitted_range.json");
pub(crate) const MINIFIED: &str = include_str!("../../examples/mipmapped_shadows.json");
pub(crate) const AIR: &str = include_str!("../../examples/volumetric_scattering.json");
pub(crate) const MAP_ALONE: &str = include_str!("../../examples/forward_shading.json");

pub(crate) fn gpu() -> Gpu {
    Gpu::open(Profile::Native).unwrap()
}

pub(crate) fn parsed(text: &str) -> Graph {
    Graph::parse(text, &NodeRegistry::new()).unwrap()
}

/// A small frame of a scene from one of its viewpoints.
pub(crate) fn frame(gpu: &Gpu, view: u32, size: [u32; 2]) -> Frame {
    let options = RenderOptions {
        view,
        ..Default::default()
    };
    let drawn = Drawn {
        picture: size,
        map: [256; 2],
        ..Drawn::default()
    };
    let scene = scene::load("hall").unwrap();
    options.frame(gpu, &scene, &drawn, 4).unwrap()
}

pub(crate) fn imports(frame: &Frame) -> [(&'static str, ImportedResource); 2] {
    let light = ImportedResource::from(&frame.light_map.texture);
    let camera = ImportedResource::from(&frame.surface.depth);
    [("light_depth", light), ("camera_depth", camera)]
}

pub(crate) fn session(gpu: &Gpu, text: &str, imports: &[(&str, ImportedResource)]) -> Session {
    let options = Default::default();
    let session = Session::new(&gpu.adapter, &gpu.device, parsed(text), imports, options);
    block_on(session).unwrap()
}

/// Where a frame's camera and light are.
pub(crate) fn places(frame: &Frame) -> (CameraView, LightView) {
    (camera_view(&frame.desc).unwrap(), light_view(&frame.desc))
}

/// Records everything and reads an output of camera `view`.
pub(crate) fn recorded(gpu: &Gpu, session: &Session, view: usize, output: &str) -> Vec<u8> {
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    for stage in Stage::ALL {
        session.record(stage, &mut encoder).unwrap();
    }
    gpu.queue.submit([encoder.finish()]);
    gpu.check().unwrap();
    let texture = session.output(view, output).unwrap();
    gpu.read_texture(texture, 0, output).unwrap()
}
