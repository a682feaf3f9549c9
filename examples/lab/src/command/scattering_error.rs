//! `moment-shadows scattering-error`: light in the air against marched rays, with pictures and costs.

use moment_shadows_graph::nodes::Overestimation;

use crate::compare::{self, Report, compare};
use crate::cost::clock::FEATURES;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::scattering::{
    PROFILE, ScatteringSetting, ScatteringStage, ScatteringStageDesc, candidates,
};

/// What to compare.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct ScatteringErrorOptions {
    /// Viewpoint, medium, maps and picture.
    #[command(flatten)]
    pub stage: ScatteringStageDesc,
    /// How strongly our nodes lean towards a bound, looking towards the light and away from it: from 0, the middle of the bounds,
    /// to 1, as published.
    #[arg(long, num_args = 2, value_names = ["TOWARDS", "AWAY"])]
    pub overestimation: Option<Vec<f32>>,
    /// Scenes, and what becomes of the comparison.
    #[command(flatten)]
    pub compare: compare::Options,
}

/// Judges our nodes, marching and a convolution map on each scene.
pub fn run(options: &ScatteringErrorOptions) -> Result<Vec<Report<ScatteringSetting>>, LabError> {
    let gpu = Gpu::open_with(PROFILE, FEATURES)?;
    let overestimation = match options.overestimation.as_deref() {
        Some(&[towards, away]) => Overestimation { towards, away },
        _ => Overestimation::default(),
    };
    let stage = &options.stage;
    let candidates = candidates(&gpu, stage.radius, stage.extent(), overestimation)?;
    compare(&gpu, &options.compare, candidates, |scene| {
        ScatteringStage::new(&gpu, scene, stage)
    })
}
