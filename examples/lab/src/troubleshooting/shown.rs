//! A frame with its shadows, by the short path and by its objects.

use moment_shadows::{CameraView, LeakReduction, LightView, ReceiverBias, Technique};
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_graph::{Graph, Session, Stage};
use pollster::block_on;

use crate::error::LabError;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::{GraphFrame, read_intensity, receiver_bias};

/// Hard shadows in single precision.
const GRAPH: &str = include_str!("../../../hard_shadows.json");

/// A picture with shadows, and how dark they are.
#[derive(Clone)]
pub struct Shown {
    /// Shadow intensity per pixel.
    pub shadow: Vec<f32>,
    /// The picture, as sRGB bytes with alpha.
    pub picture: Vec<u8>,
}

/// The graph, with maps of so many regions.
fn graph(regions: u32) -> String {
    let regions = format!("\"samples\": 4, \"regions\": {regions}");
    let shade =
        "\"type\": \"shade_hard\", \"properties\": { \"format\": \"r32float\", \"views\": 2 }";
    GRAPH
        .replacen("\"samples\": 4", &regions, 1)
        .replacen("\"type\": \"shade_hard\"", shade, 1)
}

/// A frame as a host shows it that says so of its camera and its light, whose map has so many regions.
pub(super) fn by_session(
    gpu: &Gpu,
    frame: &Frame,
    regions: u32,
    camera: &CameraView,
    lights: &[LightView],
    leak_reduction: LeakReduction,
) -> Result<Shown, LabError> {
    let graph: Graph = graph(regions).parse()?;
    let imports = [
        (
            "light_depth",
            ImportedResource::from(&frame.light_map.texture),
        ),
        ("camera_depth", ImportedResource::from(frame.camera_depth())),
    ];
    let options = Default::default();
    let session = Session::new(&gpu.adapter, &gpu.device, graph, &imports, options);
    let mut session = block_on(session)?;
    session.leak_reduction = leak_reduction;
    session.view(&gpu.queue, 0, camera, lights)?;
    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    for stage in Stage::ALL {
        session.record(stage, &mut encoder)?;
    }
    gpu.queue.submit([encoder.finish()]);
    gpu.check()?;
    let shadow = session.output(0, "shadow_intensity").ok_or_else(|| {
        LabError::unsuitable("hard_shadows.json", "it has no output 'shadow_intensity'")
    })?;
    shown(gpu, frame, shadow)
}

/// A frame by a technique, with another receiver bias than the one that follows from its graph.
pub(super) fn by_objects(
    gpu: &Gpu,
    frame: &Frame,
    technique: &Technique,
    bias: impl FnOnce(ReceiverBias) -> ReceiverBias,
) -> Result<Shown, LabError> {
    let file = GraphFile::parse("hard_shadows.json", graph(1), None)?;
    let file = file.with_technique(technique, None)?;
    let objects = GraphFrame::new(gpu, frame, &file)?;
    let usual = receiver_bias(&frame.desc, &file)?;
    objects.fill_biased(gpu, &frame.desc, &file, bias(usual))?;
    objects.run(gpu)?;
    shown(gpu, frame, objects.shadow(&file)?)
}

fn shown(gpu: &Gpu, frame: &Frame, shadow: &wgpu::Texture) -> Result<Shown, LabError> {
    Ok(Shown {
        shadow: read_intensity(gpu, shadow)?,
        picture: frame.picture(gpu, shadow)?,
    })
}

/// What differs between two frames, tenfold: black where nothing does.
pub(super) fn difference(a: &Shown, b: &Shown) -> Shown {
    let shadow = a.shadow.iter().zip(&b.shadow);
    let shadow: Vec<f32> = shadow.map(|(a, b)| (a - b).abs()).collect();
    let picture = shadow.iter().flat_map(|&difference| {
        let grey = (2550.0 * difference + 0.5) as u8;
        [grey, grey, grey, 255]
    });
    Shown {
        picture: picture.collect(),
        shadow,
    }
}
