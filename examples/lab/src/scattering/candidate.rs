//! Ways to light the air that are compared.

use moment_shadows::{Profile, Storage, Technique as MapTechnique};
use serde_json::json;

use super::chain::{Link, graph};
use super::convolution::ConvolutionRows;
use super::march::{Marcher, Marching};
use super::stage::ScatteringStage;
use crate::compare::Technique;
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
    /// A convolution map with these columns and rows.
    Convolution([u32; 2]),
}

/// Our nodes with six and four moments in float16, and in unorm16 where the device has it; the convolution map of the same
/// extent; marching.
pub fn candidates(
    gpu: &Gpu,
    radius: u32,
    extent: [u32; 2],
    overestimation: [f32; 2],
) -> Result<Vec<ScatteringCandidate>, LabError> {
    let has_unorm16 = gpu
        .device
        .features()
        .contains(wgpu::Features::TEXTURE_FORMAT_16BIT_NORM);
    let mut all = Vec::new();
    let mut storages = vec![Storage::Float16];
    storages.extend(has_unorm16.then_some(Storage::Unorm16));
    for (count, technique) in [(6, MapTechnique::Hamburger6), (4, MapTechnique::Hamburger4)] {
        for &storage in &storages {
            all.push(ScatteringCandidate {
                name: format!("{count} moments {storage}"),
                fetches: f64::from(count / 2 - 1).max(1.0),
                way: Way::Graph(nodes(&technique, storage, radius, extent, overestimation)?),
            });
        }
    }
    all.push(ScatteringCandidate {
        name: "convolution".to_owned(),
        fetches: 4.0,
        way: Way::Convolution(extent),
    });
    let mut march = |name: String, fetches: f64, how: Marching| {
        all.push(ScatteringCandidate {
            name,
            fetches,
            way: Way::March(how),
        });
    };
    for half in [false, true] {
        for steps in STEPS {
            let (name, fetches) = match (half, f64::from(steps)) {
                (true, fetches) => ("half march", fetches / 4.0 + 4.0),
                (false, fetches) => ("march", fetches),
            };
            let how = Marching {
                steps,
                half,
                filtered: None,
            };
            march(format!("{name} {steps}"), fetches, how);
        }
    }
    let storage = if has_unorm16 {
        Storage::Unorm16
    } else {
        Storage::Float32
    };
    let links = [Link::resolve(storage), Link::blur(radius, None)];
    let steps = STEPS_THROUGH_MOMENTS;
    let how = Marching {
        steps,
        half: false,
        filtered: Some((graph("filtered", &links)?, storage)),
    };
    march(format!("moments {steps}"), f64::from(steps), how);
    Ok(all)
}

/// The chain of the library's nodes.
fn nodes(
    technique: &MapTechnique,
    storage: Storage,
    radius: u32,
    extent: [u32; 2],
    [towards, away]: [f32; 2],
) -> Result<GraphFile, LabError> {
    let rectify =
        json!({ "technique": technique, "storage": storage.to_string(), "extent": extent });
    let links = [
        Link::resolve(storage),
        Link::blur(radius, None),
        Link("rectify_moments", rectify, ["map", "rectified"]),
        Link(
            "integrate_scattering",
            json!({}),
            ["rectified", "integrated"],
        ),
        Link(
            "composite_scattering",
            json!({ "overestimation": { "towards": towards, "away": away } }),
            ["integrated", "scattering"],
        ),
    ];
    graph("scattering", &links)
}

/// The profile of the device that candidates run on.
pub const PROFILE: Profile = Profile::Native;

impl ScatteringCandidate {
    /// Binds it to a stage.
    pub(super) fn bind(
        &self,
        gpu: &Gpu,
        stage: &ScatteringStage,
    ) -> Result<Box<dyn Technique>, LabError> {
        Ok(match &self.way {
            Way::Graph(file) => Box::new(GraphFrame::in_air(
                gpu,
                stage.frame(),
                file,
                Some(&stage.air),
            )?),
            Way::March(how) => Box::new(Marcher::new(gpu, stage, how)?),
            Way::Convolution(extent) => Box::new(ConvolutionRows::new(gpu, stage, *extent)?),
        })
    }

    /// Steps, if it marches the plain map at full resolution.
    #[must_use]
    pub fn steps(&self) -> Option<u32> {
        match &self.way {
            Way::March(how) if !how.half && how.filtered.is_none() => Some(how.steps),
            Way::March(_) | Way::Graph(_) | Way::Convolution(_) => None,
        }
    }

    /// Whether it is made of the library's nodes.
    #[must_use]
    pub fn is_ours(&self) -> bool {
        matches!(self.way, Way::Graph(_))
    }
}
