//! Ways to light the air that are compared.

use moment_shadows::{Profile, Storage, Technique as MapTechnique};

use super::chain::Chain;
use super::convolution::ConvolutionRows;
use super::march::Marcher;
use super::stage::ScatteringStage;
use crate::compare::Technique;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;

/// Six moments as they were published.
const TEN_BITS: &str = "6 moments unorm10";

/// Steps of marching.
const STEPS: [u32; 4] = [16, 32, 64, 128];

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
    /// Marching through the plain map, with so many steps per ray. With `half`, half as many columns and rows are marched with
    /// steps that are shifted from pixel to pixel, and the rest is interpolated bilaterally.
    March { steps: u32, half: bool },
    /// A convolution map with these columns and rows.
    Convolution([u32; 2]),
}

/// Our nodes with six and four moments in float16 and six in unorm8; six moments that are looked up with 10 bits; the convolution map of
/// the same extent; marching.
pub fn candidates(radius: u32, extent: [u32; 2]) -> Result<Vec<ScatteringCandidate>, LabError> {
    let mut all = Vec::new();
    let mut push = |name: String, fetches: f64, way: Way| {
        all.push(ScatteringCandidate { name, fetches, way });
    };
    for (count, technique, storage) in [
        (6, MapTechnique::Hamburger6, Storage::Float16),
        (4, MapTechnique::Hamburger4, Storage::Float16),
        (6, MapTechnique::Hamburger6, Storage::Unorm8),
    ] {
        let chain = Chain {
            map: Storage::Float16,
            radius: Some(radius),
            rectify: "rectify_moments",
            rectified: (technique, storage),
            extent,
            seen: true,
            composite: "composite_scattering",
        };
        let fetches = f64::from(count / 2 - 1).max(1.0);
        let way = Way::Graph(chain.graph()?);
        push(format!("{count} moments {storage}"), fetches, way);
    }
    let chain = Chain {
        map: Storage::Float16,
        radius: Some(radius),
        rectify: "rectify_moments",
        rectified: (MapTechnique::Hamburger6, Storage::Unorm16),
        extent,
        seen: true,
        composite: "composite_ten_bits",
    };
    push(TEN_BITS.to_owned(), 2.0, Way::Graph(chain.graph()?));
    push("convolution".to_owned(), 4.0, Way::Convolution(extent));
    for steps in STEPS {
        let way = Way::March { steps, half: false };
        push(format!("march {steps}"), f64::from(steps), way);
    }
    for steps in STEPS {
        let way = Way::March { steps, half: true };
        push(
            format!("half march {steps}"),
            f64::from(steps) / 4.0 + 4.0,
            way,
        );
    }
    Ok(all)
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
            Way::March { steps, half } => Box::new(Marcher::new(gpu, stage, *steps, *half)?),
            Way::Convolution(extent) => Box::new(ConvolutionRows::new(gpu, stage, *extent)?),
        })
    }

    /// Steps, if it marches the plain map at full resolution.
    #[must_use]
    pub fn steps(&self) -> Option<u32> {
        match self.way {
            Way::March { steps, half: false } => Some(steps),
            Way::March { .. } | Way::Graph(_) | Way::Convolution(_) => None,
        }
    }

    /// Whether it is made of the library's nodes.
    #[must_use]
    pub fn is_ours(&self) -> bool {
        matches!(self.way, Way::Graph(_)) && self.name != TEN_BITS
    }
}
