//! Ways to light the air that are compared.

use moment_shadows::{Profile, Storage, Technique};
use moment_shadows_graph::Stage;
use moment_shadows_graph::nodes::Overestimation;
use moment_shadows_graph::record::Recording;

use super::convolution::ConvolutionRows;
use super::march::{Marcher, Marching};
use super::stage::ScatteringStage;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;

/// Steps of marching.
const STEPS: [u32; 4] = [16, 32, 64, 128];

/// Steps of marching through the filtered map.
const STEPS_THROUGH_MOMENTS: u32 = 1024;

/// A way to light the air.
#[derive(Debug)]
pub struct ScatteringCandidate {
    /// What tables and files call it.
    pub name: String,
    /// What it looks up per pixel of the picture: fetches of maps.
    pub fetches: f64,
    way: Way,
}

#[derive(Debug)]
enum Way {
    /// The library's nodes: a graph with an output `scattering`.
    Graph(GraphFile),
    March(Marching),
    /// Through the filtered map of a graph, in a storage.
    MarchMoments(u32, GraphFile, Storage),
    /// With columns and rows of the map.
    Convolution([u32; 2]),
}

/// A candidate that is bound to a stage.
pub struct BoundCandidate {
    bound: BoundWay,
}

enum BoundWay {
    Graph(Box<GraphFrame>),
    March(Marcher),
    Convolution(ConvolutionRows),
}

/// Our nodes with six and four moments in float16, and in unorm16 where the device has it; the convolution map of the same
/// extent; marching.
pub fn candidates(
    gpu: &Gpu,
    radius: u32,
    extent: [u32; 2],
    overestimation: Overestimation,
) -> Result<Vec<ScatteringCandidate>, LabError> {
    let has_unorm16 = gpu
        .device
        .features()
        .contains(wgpu::Features::TEXTURE_FORMAT_16BIT_NORM);
    let mut all = Vec::new();
    let mut storages = vec![Storage::Float16];
    storages.extend(has_unorm16.then_some(Storage::Unorm16));
    for (count, technique) in [(6, Technique::Hamburger6), (4, Technique::Hamburger4)] {
        for &storage in &storages {
            all.push(ScatteringCandidate {
                name: format!("{count} moments {storage}"),
                fetches: f64::from(count / 2 - 1).max(1.0),
                way: Way::Graph(graph(&technique, storage, radius, extent, overestimation)?),
            });
        }
    }
    all.push(ScatteringCandidate {
        name: "convolution".to_owned(),
        fetches: 4.0,
        way: Way::Convolution(extent),
    });
    for half in [false, true] {
        for steps in STEPS {
            let name = if half { "half march" } else { "march" };
            all.push(ScatteringCandidate {
                name: format!("{name} {steps}"),
                fetches: if half {
                    f64::from(steps) / 4.0 + 4.0
                } else {
                    f64::from(steps)
                },
                way: Way::March(Marching {
                    steps,
                    half,
                    dithered: half,
                }),
            });
        }
    }
    let storage = if has_unorm16 {
        Storage::Unorm16
    } else {
        Storage::Float32
    };
    all.push(ScatteringCandidate {
        name: format!("moments {STEPS_THROUGH_MOMENTS}"),
        fetches: f64::from(STEPS_THROUGH_MOMENTS),
        way: Way::MarchMoments(STEPS_THROUGH_MOMENTS, filtered(storage, radius)?, storage),
    });
    Ok(all)
}

/// The chain of the library's nodes.
fn graph(
    technique: &Technique,
    storage: Storage,
    radius: u32,
    extent: [u32; 2],
    overestimation: Overestimation,
) -> Result<GraphFile, LabError> {
    let [columns, rows] = extent;
    let technique = serde_json::to_value(technique).unwrap_or_default();
    let overestimation = serde_json::to_value(overestimation).unwrap_or_default();
    let text = format!(
        r#"{{
  "version": 2,
  "imports": [{{ "name": "light_depth" }}, {{ "name": "camera_depth" }}],
  "nodes": [
    {{ "name": "resolve", "type": "resolve", "properties": {{ "storage": "{storage}" }} }},
    {{ "name": "blur", "type": "blur", "properties": {{ "kernel": {{ "radius": {radius} }} }} }},
    {{ "name": "rectify", "type": "rectify_moments",
       "properties": {{ "technique": {technique}, "storage": "{storage}", "extent": [{columns}, {rows}] }} }},
    {{ "name": "integrate", "type": "integrate_scattering" }},
    {{ "name": "composite", "type": "composite_scattering", "properties": {{ "overestimation": {overestimation} }} }}
  ],
  "edges": [
    {{ "from": "light_depth", "to": "resolve.depth" }},
    {{ "from": "resolve.map", "to": "blur.map" }},
    {{ "from": "blur.blurred", "to": "rectify.map" }},
    {{ "from": "rectify.rectified", "to": "integrate.rectified" }},
    {{ "from": "integrate.integrated", "to": "composite.integrated" }},
    {{ "from": "camera_depth", "to": "composite.camera_depth" }}
  ],
  "outputs": [{{ "name": "scattering", "from": "composite.scattering" }}]
}}"#
    );
    GraphFile::parse("scattering.json", text, None)
}

/// The filtered map alone.
fn filtered(storage: Storage, radius: u32) -> Result<GraphFile, LabError> {
    let text = format!(
        r#"{{
  "version": 2,
  "imports": [{{ "name": "light_depth" }}, {{ "name": "camera_depth" }}],
  "nodes": [
    {{ "name": "resolve", "type": "resolve", "properties": {{ "storage": "{storage}" }} }},
    {{ "name": "blur", "type": "blur", "properties": {{ "kernel": {{ "radius": {radius} }} }} }}
  ],
  "edges": [
    {{ "from": "light_depth", "to": "resolve.depth" }},
    {{ "from": "resolve.map", "to": "blur.map" }}
  ],
  "outputs": [{{ "name": "map", "from": "blur.blurred" }}]
}}"#
    );
    GraphFile::parse("filtered.json", text, None)
}

/// The profile of the device that candidates run on.
pub const PROFILE: Profile = Profile::Native;

impl ScatteringCandidate {
    /// Binds it to a stage.
    pub fn bind(&self, gpu: &Gpu, stage: &ScatteringStage) -> Result<BoundCandidate, LabError> {
        let bound = match &self.way {
            Way::Graph(file) => BoundWay::Graph(Box::new(GraphFrame::in_air(
                gpu,
                stage.frame(),
                file,
                Some(&stage.air),
            )?)),
            Way::March(how) => BoundWay::March(Marcher::new(gpu, stage, *how)?),
            Way::MarchMoments(steps, file, storage) => BoundWay::March(Marcher::through_moments(
                gpu, stage, *steps, file, *storage,
            )?),
            Way::Convolution(extent) => {
                BoundWay::Convolution(ConvolutionRows::new(gpu, stage, *extent)?)
            }
        };
        Ok(BoundCandidate { bound })
    }

    /// Steps, if it marches the plain map at full resolution.
    #[must_use]
    pub fn steps(&self) -> Option<u32> {
        match &self.way {
            Way::March(how) if !how.half => Some(how.steps),
            _ => None,
        }
    }

    /// Whether it is made of the library's nodes.
    #[must_use]
    pub fn is_ours(&self) -> bool {
        matches!(self.way, Way::Graph(_))
    }

    /// The name as a part of a file's name.
    #[must_use]
    pub fn file_stem(&self) -> String {
        self.name.replace(' ', "-")
    }
}

impl BoundCandidate {
    /// Whether anything is done to the light's map.
    #[must_use]
    pub fn makes_map(&self) -> bool {
        match &self.bound {
            BoundWay::Graph(_) | BoundWay::Convolution(_) => true,
            BoundWay::March(marcher) => marcher.moments().is_some(),
        }
    }

    /// Records what is done to the light's map.
    pub fn record_map(&self, encoder: &mut wgpu::CommandEncoder) -> Result<(), LabError> {
        let stage = |graph: &GraphFrame, encoder: &mut wgpu::CommandEncoder| {
            (graph.bindings).record(Stage::AfterShadowMaps, encoder, Recording::default())
        };
        match &self.bound {
            BoundWay::Graph(graph) => stage(graph, encoder)?,
            BoundWay::March(marcher) => {
                if let Some(graph) = marcher.moments() {
                    stage(graph, encoder)?;
                }
            }
            BoundWay::Convolution(rows) => rows.record_map(encoder),
        }
        Ok(())
    }

    /// Records what is done per pixel.
    pub fn record_pixels(&self, encoder: &mut wgpu::CommandEncoder) -> Result<(), LabError> {
        match &self.bound {
            BoundWay::Graph(graph) => {
                (graph.bindings).record(Stage::AfterMainPass, encoder, Recording::default())?;
            }
            BoundWay::March(marcher) => marcher.record_pixels(encoder),
            BoundWay::Convolution(rows) => rows.record_pixels(encoder),
        }
        Ok(())
    }

    /// Lights the air, and reads radiance and transmittance per pixel, the top row first.
    pub fn picture(&self, gpu: &Gpu) -> Result<Vec<[f32; 4]>, LabError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.record_map(&mut encoder)?;
        self.record_pixels(&mut encoder)?;
        gpu.queue.submit([encoder.finish()]);
        gpu.check()?;
        let texture = match &self.bound {
            BoundWay::Graph(graph) => {
                graph
                    .bindings
                    .output("scattering")
                    .ok_or_else(|| LabError::Unsuitable {
                        file: "scattering.json".to_owned(),
                        reason: "it has no output 'scattering'".to_owned(),
                    })?
            }
            BoundWay::March(marcher) => marcher.radiance(),
            BoundWay::Convolution(rows) => rows.radiance(),
        };
        let bytes = gpu.read_texture(texture, 0, "radiance")?;
        let halves = bytes.chunks_exact(8).map(|pixel| {
            std::array::from_fn(|channel| {
                half::f16::from_le_bytes([pixel[2 * channel], pixel[2 * channel + 1]]).to_f32()
            })
        });
        Ok(halves.collect())
    }
}
