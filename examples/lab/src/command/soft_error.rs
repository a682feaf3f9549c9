//! `moment-shadows-lab soft-error`: soft shadows against a sampled area light, with pictures and costs.

use crate::compare::{self, Report, compare};
use crate::cost::blur::PROFILE;
use crate::cost::clock::FEATURES;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::soft::{NamedGraph, SoftErrors, SoftStage, StageDesc, candidates};

/// What to compare.
#[derive(Clone, Debug, Default, PartialEq, clap::Args)]
pub struct SoftErrorOptions {
    /// Light, map and picture.
    #[command(flatten)]
    pub stage: StageDesc,
    /// Another technique: a graph file, with a name before it if you like (NAME=FILE). Several may be given.
    #[arg(long)]
    pub graph: Vec<NamedGraph>,
    /// Scenes, and what becomes of the comparison.
    #[command(flatten)]
    pub compare: compare::Options,
}

/// Judges hard and percentage closer soft shadows, moment soft shadows and the graphs on each scene.
pub fn run(options: &SoftErrorOptions) -> Result<Vec<Report<SoftErrors>>, LabError> {
    let candidates = candidates(&options.graph)?;
    let gpu = Gpu::open_with(PROFILE, FEATURES)?;
    compare(&gpu, &options.compare, candidates, |scene| {
        SoftStage::new(&gpu, scene, &options.stage)
    })
}
