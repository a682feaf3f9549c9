//! `moment-shadows-lab march-error`: marched light in the air of any light against rays of 1,024 steps.

use crate::compare::{self, Report, compare};
use crate::cost::clock::FEATURES;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::scattering::{
    Lamp, MarchErrors, MarchStage, MarchStageDesc, PROFILE, WaysRecord, march_candidates,
};

/// What to compare.
#[derive(Clone, Debug, PartialEq, clap::Args)]
pub struct MarchErrorOptions {
    /// Viewpoint, light, fog, maps and picture.
    #[command(flatten)]
    pub stage: MarchStageDesc,
    /// Scenes, and what becomes of the comparison.
    #[command(flatten)]
    pub compare: compare::Options,
    /// Judges every light in its turn, and writes the record that `ScatteringWay::best` is held to; in a checkout.
    #[arg(long, conflicts_with_all = ["only", "light", "falloff", "undithered"])]
    pub update: bool,
}

/// Lights and falls of density that are recorded.
const RECORDED: [(Lamp, f64); 4] = [
    (Lamp::Sun, 0.0),
    (Lamp::Sun, 2.0),
    (Lamp::Spot, 2.0),
    (Lamp::Point, 2.0),
];

/// Judges marching with filtered maps and with plain ones on each scene, beside prefiltered scattering where the light is a sun in
/// homogeneous air.
pub fn run(options: &MarchErrorOptions) -> Result<Vec<Report<MarchErrors>>, LabError> {
    let gpu = Gpu::open_with(PROFILE, FEATURES)?;
    let mut record = WaysRecord {
        scenes: options.compare.scene.clone(),
        rows: Vec::new(),
    };
    let one = [(options.stage.light, options.stage.falloff)];
    let settings: &[_] = if options.update { &RECORDED } else { &one };
    let mut all = Vec::new();
    for &(light, falloff) in settings {
        let stage = MarchStageDesc {
            light,
            falloff,
            ..options.stage
        };
        let candidates = || {
            let prefiltered = light == Lamp::Sun && falloff == 0.0;
            march_candidates(stage.views(), stage.radius, !stage.undithered, prefiltered)
        };
        let reports = compare(&gpu, &options.compare, candidates()?, |scene| {
            MarchStage::new(&gpu, scene, &stage)
        })?;
        record.add((light, falloff), &candidates()?, &reports);
        all.extend(reports);
    }
    if options.update {
        record.save()?;
    }
    Ok(all)
}
