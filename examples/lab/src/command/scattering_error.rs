//! `moment-shadows-lab scattering-error`: light in the air against marched rays, with pictures and costs.

use crate::compare::{self, Report, compare};
use crate::cost::clock::FEATURES;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::scattering::{
    PROFILE, ScatteringErrors, ScatteringStage, ScatteringStageDesc, candidates,
};

/// What to compare.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct ScatteringErrorOptions {
    /// Viewpoint, medium, maps and picture.
    #[command(flatten)]
    pub stage: ScatteringStageDesc,
    /// Scenes, and what becomes of the comparison.
    #[command(flatten)]
    pub compare: compare::Options,
}

/// Judges our nodes, marching and a convolution map on each scene.
pub fn run(options: &ScatteringErrorOptions) -> Result<Vec<Report<ScatteringErrors>>, LabError> {
    let gpu = Gpu::open_with(PROFILE, FEATURES)?;
    let stage = &options.stage;
    let candidates = candidates(stage.radius, stage.extent())?;
    compare(&gpu, &options.compare, candidates, |scene| {
        ScatteringStage::new(&gpu, scene, stage)
    })
}
