//! What one combination costs and how far it is off.

use moment_shadows::{Storage, TextureFormat};
use moment_shadows_graph::{Stage as PassStage, TextureDesc};
use rayon::prelude::*;

use super::axes::Cell;
use super::isa::Kept;
use super::results::{Errors, Row, Time};
use super::stage::Stage;
use crate::compare::Technique;
use crate::cost::clock::{Clock, ClockKind};
use crate::cost::copies::{Copies, CopyWork};
use crate::cost::protocol::{Rounds, Subject};
use crate::error::LabError;
use crate::flip::flip;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;
use crate::metric::compare;
use crate::surface_error::{MapEvaluator, MapRun};
use crate::techniques::described;

/// Times in copies, and what a kept table says of shaders.
pub struct Meter<'a> {
    clock: Clock<'a>,
    copy: Copies,
    kept: Kept,
}

/// What a row of results is made of besides its figures: the picture of its worst view.
pub struct Measured {
    /// The row.
    pub row: Row,
    /// The number of the worst view among the stage's.
    pub worst: usize,
    /// Shadow intensity per pixel of that view.
    pub picture: Vec<f32>,
}

/// Texels per side of what the unit of time copies.
const UNIT: u32 = 1024;

impl<'a> Meter<'a> {
    /// A meter of a device.
    pub fn new(gpu: &'a Gpu, kept: Kept) -> Result<Self, LabError> {
        let copied = TextureDesc::new(TextureFormat::Rgba16Float, [UNIT; 2]);
        Ok(Self {
            clock: Clock::new(gpu, ClockKind::for_device(gpu)),
            copy: Copies::new(gpu, &[copied], CopyWork::Compute)?,
            kept,
        })
    }

    /// Measures a combination on frames of all views of a stage.
    pub fn measure(
        &self,
        stage: &Stage<'_>,
        frames: &[Frame],
        cell: Cell,
    ) -> Result<Measured, LabError> {
        let file = stage.axes.graph(stage.file, cell)?;
        let (views, technique, (storage, bits), worst) = errors(stage, frames, cell, &file)?;
        let graph = GraphFrame::new(stage.gpu, &frames[0], &file)?;
        graph.run(stage.gpu)?;
        let name = described(&technique);
        let row = Row {
            cell,
            isa: self.kept.shading(&technique, storage),
            storage,
            bits_per_texel: bits,
            bytes_resident: graph.plan.bytes_resident(),
            bytes_moved: graph.plan.bytes_moved(),
            time: self.time(&name, &graph, stage.setting.rounds)?,
            name,
            technique,
            views,
        };
        Ok(Measured {
            row,
            worst: worst.0,
            picture: worst.1,
        })
    }

    /// Times both stages of a graph beside the copy.
    fn time(&self, name: &str, graph: &GraphFrame, rounds: u32) -> Result<Time, LabError> {
        let subject = |stage: PassStage| Subject {
            name: format!("{name} {stage:?}"),
            record: Box::new(move |encoder| Technique::record(graph, stage, encoder)),
        };
        let mut subjects = vec![Subject {
            name: "copy".to_owned(),
            record: self.copy.by_shader(),
        }];
        let mut numbers = Vec::new();
        for stage in PassStage::ALL {
            let works = graph.works_in(stage);
            numbers.push(Vec::from_iter(works.then_some(subjects.len())));
            subjects.extend(works.then(|| subject(stage)));
        }
        let times = Rounds::run(&self.clock, &subjects, rounds, || ())?;
        let ratio = |subjects: &[usize]| times.ratio(subjects, &[0]);
        Ok(Time {
            map: ratio(&numbers[0]),
            pixels: ratio(&numbers[1]),
            total: ratio(&numbers.concat()),
        })
    }
}

/// Errors of all views, what was looked up, and the worst picture with its view.
type Judged = (
    Vec<Errors>,
    moment_shadows::Technique,
    (Option<Storage>, u32),
    (usize, Vec<f32>),
);

/// Judges a combination on frames of all views of a stage.
pub(super) fn errors(
    stage: &Stage<'_>,
    frames: &[Frame],
    cell: Cell,
    file: &GraphFile,
) -> Result<Judged, LabError> {
    let gpu = stage.gpu;
    let softness = stage.axes.softness(cell);
    let mut run = MapRun::new(gpu, &frames[0], file)?;
    let (mut errors, mut worst) = (Vec::new(), (0, Vec::new()));
    let mut lit = Vec::new();
    let mut largest = f64::NEG_INFINITY;
    let mut looked_up = None;
    for (index, (view, frame)) in stage.views.iter().zip(frames).enumerate() {
        if index > 0 {
            run.rerun(gpu, frame)?;
        }
        let truth = &view.truths[softness];
        let shadow = run.graph.read_shadow(gpu, &run.file)?;
        let picture = compare(&shadow, &truth.picture.shadow, &truth.picture.facing)?;
        lit.push(frame.picture(gpu, run.graph.shadow(&run.file)?)?);
        let map = run.map(frame)?;
        let evaluator = MapEvaluator::new(gpu, &map, None)?;
        let surfaces = (truth.surfaces).judge_size(&evaluator, run.shading, frame.desc.map)?;
        looked_up = Some((map.technique(), (map.storage(), map.bits_per_texel())));
        errors.push(Errors::of(view.number, &picture, &surfaces));
        let error = picture.facing.mean_absolute;
        if error > largest || index == 0 {
            (largest, worst) = (error, (index, shadow));
        }
    }
    let seen = lit.par_iter().zip(&stage.views);
    let flips: Result<Vec<f64>, LabError> = seen
        .map(|(lit, view)| flip(stage.setting.picture, &view.truths[softness].lit, lit))
        .collect();
    for (errors, flip) in errors.iter_mut().zip(flips?) {
        errors.flip = Some(flip);
    }
    let (technique, stored) =
        looked_up.ok_or_else(|| LabError::refused("a trade needs at least one view"))?;
    Ok((errors, technique, stored, worst))
}
