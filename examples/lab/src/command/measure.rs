//! `moment-shadows-lab measure`: errors of a technique with every storage on several scenes, beside the exact bound.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use moment_shadows::Technique;

use super::CommandResult;
use super::error::storage_name;
use super::render::RenderOptions;
use crate::candidate::{Candidate, TechniqueChoice};
use crate::cost::table::{Cell, Columns};
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;
use crate::judgement::{Judgement, Truth};
use crate::metric::{NO_PIXEL, percent};
use crate::progress;

/// What `measure` takes.
#[derive(clap::Args)]
pub struct Options {
    #[command(flatten)]
    frame: RenderOptions,
    /// A technique in place of the graph's own: a name, or settings as in a graph file.
    #[arg(long, value_name = "NAME|JSON")]
    technique: Option<TechniqueChoice>,
    /// glTF or GLB files, or procedural scenes.
    #[arg(long, num_args = 1.., default_values = ["fence-and-foliage", "hall"])]
    scene: Vec<String>,
    /// The graph file.
    #[arg(long)]
    graph: PathBuf,
}

impl Options {
    /// Prints the table.
    pub fn run(self) -> CommandResult {
        let options = RenderOptions {
            technique: self.technique,
            ..self.frame
        };
        print!("{}", Columns(&rows(&self.scene, &self.graph, &options)?));
        Ok(ExitCode::SUCCESS)
    }
}

/// Renders every scene with every storage of the technique, in single precision, and compares each with the truth.
fn rows(
    scenes: &[String],
    graph: &Path,
    options: &RenderOptions,
) -> Result<Vec<Vec<Cell<'static>>>, LabError> {
    let mut storages = match (&options.technique, options.storage) {
        (_, Some(storage)) => vec![Some(storage)],
        (None, None) => Technique::Hamburger4
            .row()
            .storages
            .iter()
            .map(|&it| Some(it))
            .collect(),
        (Some(technique), None) => technique
            .candidates()
            .iter()
            .map(Candidate::storage)
            .collect(),
    };
    if options.storage.is_none() {
        let file = GraphFile::read(graph, None)?;
        storages.retain(|&storage| file.makes(storage));
    }
    let bar = progress::bar((scenes.len() * storages.len()) as u64, "measuring");
    let mut rows = Vec::new();
    for name in scenes {
        let scene = options.load(name)?;
        let mut truth = None;
        for &storage in &storages {
            let file = options.graph(graph, storage)?.in_single_precision()?;
            let drawn = options.drawn(&file)?;
            if rows.is_empty() {
                eprintln!("{drawn}");
            }
            let gpu = Gpu::open(file.profile(drawn.samples.max(drawn.camera_samples)))?;
            let frame = options.frame(&gpu, &scene, &drawn, file.radius()?)?;
            let graph_frame = GraphFrame::new(&gpu, &frame, &file)?;
            graph_frame.run(&gpu)?;
            let shadow = graph_frame.read_shadow(&gpu, &file)?;
            let truth = match &truth {
                Some(truth) => truth,
                None => &*truth.insert(Truth::of(&gpu, &frame, &file)?),
            };
            let Judgement { error, excess, .. } = truth.judge(&shadow)?;
            let figure = |value: f64| percent(value, NO_PIXEL);
            let excess_of = |ratio: Option<f64>| {
                ratio.map_or("-".to_owned(), |ratio| format!("{:+.1} %", 100.0 * ratio))
            };
            let bound = truth.bound_error.facing.mean_absolute;
            rows.push(vec![
                ("scene", scene.name.clone()),
                ("storage", storage_name(storage).to_owned()),
                ("facing", figure(error.facing.mean_absolute)),
                ("penumbra", figure(error.penumbra.mean_absolute)),
                ("leaking", figure(error.facing.leaking)),
                ("too dark", figure(error.facing.overdarkening)),
                ("bound", figure(bound)),
                ("excess", excess_of(excess.error)),
                ("leak exc.", excess_of(excess.leaking)),
                ("NaN", error.nan_pixels.to_string()),
            ]);
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    Ok(rows)
}
