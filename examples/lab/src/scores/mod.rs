//! Scores of what players complain of: acne, peter-panning, contact and flicker, each for itself.
//!
//! An error of a picture adds all of them up, and hides that a receiver bias trades the first for the second. Here both are judged with
//! our receiver bias, which follows from the slope, and with a constant one, by the node that shades:
//!
//! - **Acne**: the mean shadow intensity, and the share of pixels with more than [`VISIBLE`], where the truth has none. Pixels are sorted
//!   by the slope of their surface against the light into classes around 0, 10, .. 80 degrees, and every class counts as much.
//! - **Peter-panning**: the mean shadow intensity that a receiver bias takes away, compared with none, from pixels in full shadow (by the
//!   truth, which knows the same kernel and map) whose caster is within [`FEET`] texels' widths in front of them.
//! - **Contact**: the mean of what is too light around the legs of the scene of chairs ([`contacts`](crate::contacts)).
//! - **Flicker**: the mean change of shadow intensity from frame to frame while the map of a parallel light slides under the scene by
//!   [`STEP`] texels, so that true shadows stand still; and that of the worst frame.

mod judge;
mod report;
mod sheet;

use std::path::{Path, PathBuf};

use moment_shadows::{Storage, Technique};
use serde::Serialize;

pub use judge::{Acne, Flicker, STEP, Scored, ViewScores};
pub use report::Report;

use self::judge::{Judge, Seen};
use crate::error::LabError;
use crate::frame::{Frame, FrameDesc};
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::scene::Scene;
use crate::surface_error::MapRun;
use crate::techniques::described;
use crate::trade::axes::Cell;
use crate::trade::{Crop, Stage, Trade, tell_of_views};

/// Shadow intensity above which acne is seen.
pub const VISIBLE: f32 = 0.1;

/// How far in front of a receiver its caster is at its feet, in widths of a texel.
pub const FEET: f64 = 32.0;

/// Fewer pixels of a class of slopes, or at feet, are not judged.
const FEWEST: usize = 64;

/// A figure with a constant receiver bias, and with ours.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Biases<T> {
    /// With a constant bias of the fragment depth.
    pub constant: T,
    /// With the bias that follows from kernel and slope, and the receiver's plane in tests on the depth map.
    pub ours: T,
}

/// What is scored.
#[derive(Clone, Debug)]
pub struct Scores {
    /// Scenes, views and combinations.
    pub trade: Trade,
    /// The graph file; none for that of the trade.
    pub graph: Option<PathBuf>,
    /// The constant bias in widths of a texel; none for what ours is on a slope of 45 degrees.
    pub constant: Option<f64>,
    /// By how many texels a light's map slides from frame to frame.
    pub step: [f64; 2],
}

/// The names of the scores, which their pictures have, too.
pub const NAMES: [&str; 4] = ["acne", "peter-panning", "contact", "flicker"];

/// The number of a score, a bias, and the part of a view's picture where it is worst.
type Part = (usize, &'static str, Crop);

/// The worst part of all views for a score and a bias.
struct Worst {
    of: (usize, &'static str),
    /// What it shows.
    told: String,
    crop: Crop,
}

impl Scores {
    /// Scores everything; with a folder, writes `scores.json` and a picture for each score into it. `done` is called after each
    /// combination on a scene.
    pub fn run(&self, folder: Option<&Path>, mut done: impl FnMut()) -> Result<Report, LabError> {
        let file = match &self.graph {
            Some(path) => GraphFile::read(path, None)?,
            None => Trade::graph()?,
        };
        let axes = &self.trade.axes;
        let gpu = Gpu::open(self.trade.profile)?;
        let setting = self.trade.setting(&gpu)?;
        let (mut rows, mut worst) = (Vec::new(), Vec::new());
        for name in &self.trade.scenes {
            tell_of_views(name)?;
            let (scene, setups) = self.trade.load(name)?;
            let stage = Stage::of(&gpu, (&file, axes), &setting, &scene);
            let mut seen = Vec::new();
            for (number, setup) in (setting.views[1]..).zip(&setups) {
                let drawn = stage.drawn(number, setup)?;
                seen.push(Seen::of(&gpu, &scene, number, &drawn)?);
            }
            for cell in axes.cells() {
                let file = axes.graph(&file, cell)?;
                let (row, crops) = self.row(&gpu, (name, &scene), &seen, cell, &file)?;
                if self.trade.shows(cell) {
                    worst.extend(sheet::worst(&row, crops));
                }
                rows.push(row);
                done();
            }
        }
        let report = Report::of(setting, rows);
        if let Some(folder) = folder {
            report.save(folder)?;
            sheet::save(folder, &worst)?;
        }
        Ok(report)
    }

    /// A combination on all views of a scene, with the worst part of each view for each score.
    fn row(
        &self,
        gpu: &Gpu,
        (name, scene): (&str, &Scene),
        seen: &[Seen],
        cell: Cell,
        file: &GraphFile,
    ) -> Result<(Scored, Vec<Part>), LabError> {
        let (mut views, mut parts) = (Vec::new(), Vec::new());
        let mut made: Option<(MapRun, Technique, Option<Storage>)> = None;
        for seen in seen {
            let desc = FrameDesc {
                map: [cell.map; 2],
                samples: cell.samples,
                ..seen.desc
            };
            let mut frame = Frame::draw(gpu, scene, desc)?;
            let run = match &mut made {
                Some((run, ..)) => {
                    run.rerun(gpu, &frame)?;
                    run
                }
                none => {
                    let run = MapRun::new(gpu, &frame, file)?;
                    let map = run.map(&frame)?;
                    let (technique, storage) = (map.technique(), map.storage());
                    &mut none.insert((run, technique, storage)).0
                }
            };
            let judge = Judge {
                gpu,
                scene,
                seen,
                softness: self.trade.axes.softness(cell),
                constant: self.constant,
                step: self.step,
            };
            let (scores, of_view) = judge.judge(&mut frame, run)?;
            views.push(scores);
            parts.extend(of_view);
        }
        let (_, technique, storage) =
            made.ok_or_else(|| LabError::refused("scores need at least one view"))?;
        let row = Scored {
            scene: name.to_owned(),
            cell,
            name: described(&technique),
            technique,
            storage,
            views,
        };
        Ok((row, parts))
    }
}
