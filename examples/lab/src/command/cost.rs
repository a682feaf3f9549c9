//! `moment-shadows-lab cost`: what passes cost, as ratios to copies, and in bytes.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use moment_shadows::Storage;

use super::drawn::Drawn;
use super::render::RenderOptions;
use super::{CommandResult, argument, print, print_all};
use crate::candidate::TechniqueChoice;
use crate::compare::{self, Report, compare};
use crate::cost::SubjectList;
use crate::cost::bandwidth::Memory;
use crate::cost::blur::{BLURS, PROFILE};
use crate::cost::clock::{Clock, ClockKind, FEATURES};
use crate::cost::graph_cost::GraphCost;
use crate::cost::harness::Measured;
use crate::cost::passes::cases;
use crate::cost::report::Conditions;
use crate::cost::scattering::NODES;
use crate::cost::summed_area::TABLES;
use crate::cost::table::CostTable;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::hard::{HardErrors, HardStage, candidates};
use crate::progress;
use crate::scene;

/// What is timed, and how.
#[derive(Clone, Debug, clap::Args)]
pub struct CostOptions {
    /// What is timed.
    #[command(flatten)]
    pub subject: CostSubject,
    /// A technique in place of the graph's own: a name with usual settings (vsm, evsm4, pcf, ...), or an object as in graph files.
    #[arg(long, value_name = "NAME|JSON", conflicts_with_all = ["blur", "summed_area_table", "scattering", "hard_shadows"])]
    pub technique: Option<TechniqueChoice>,
    /// A storage in place of the graph's own.
    #[arg(long, value_parser = argument::storage(), conflicts_with_all = ["blur", "summed_area_table", "scattering", "hard_shadows"])]
    pub storage: Option<Storage>,
    /// A memory to bound the time by, in 10^9 bytes per second, with a name if you like: 224:GTX 970. Several may be
    /// given; by default three cards.
    #[arg(long, value_name = "GB/S[:NAME]", conflicts_with_all = ["blur", "summed_area_table", "scattering", "hard_shadows"])]
    pub bandwidth: Vec<Memory>,
    /// Texels per side of the light's map, and the largest of lists. Where it is left out, the size that a graph's import
    /// 'light_depth' has, or 1024.
    #[arg(long, value_parser = clap::value_parser!(u32).range(256..=8192))]
    pub size: Option<u32>,
    /// Rounds, at least 9.
    #[arg(long, default_value_t = 15, value_parser = clap::value_parser!(u32).range(9..=1000))]
    pub rounds: u32,
    /// Prints JSON.
    #[arg(long)]
    pub json: bool,
}

/// One of what can be timed.
#[derive(Clone, Debug, clap::Args)]
#[group(required = true, multiple = false)]
pub struct CostSubject {
    /// A graph file: each of its passes, and all together.
    pub graph: Option<PathBuf>,
    /// The blur in both directions. Fails where a radius costs more than it may on a software adapter.
    #[arg(long)]
    pub blur: bool,
    /// Summed-area tables of maps from 256 texels per side up to the size, beside the usual way to make them. Fails where
    /// they cost more than they may on a software adapter.
    #[arg(long)]
    pub summed_area_table: bool,
    /// The nodes of single scattering on maps from 256 texels per side up to the size, with both ways to sum rows up. Fails
    /// where they cost more than they may on a software adapter.
    #[arg(long)]
    pub scattering: bool,
    /// Hard shadows from end to end at 1920x1080: moments and exponential variance in 64 bits per texel beside comparisons in the shader,
    /// with their errors.
    #[arg(long)]
    pub hard_shadows: bool,
}

impl CostOptions {
    /// Prints what the subject costs; fails where a gate is passed.
    pub fn run(self) -> CommandResult {
        if let Some(path) = &self.subject.graph {
            let options = RenderOptions {
                map: self.size,
                technique: self.technique,
                storage: self.storage,
                ..RenderOptions::default()
            };
            let cost = graph(path, &options, self.rounds, self.bandwidth)?;
            return print(&cost, self.json);
        }
        let [usual, _] = Drawn::default().map;
        let largest = self.size.unwrap_or(usual);
        if self.subject.hard_shadows {
            let reports = hard_shadows(largest, self.rounds)?;
            return print_all(&reports, self.json);
        }
        let cost = table(&self.subject.list(), largest, self.rounds)?;
        print(&cost, self.json)?;
        Ok(match cost.passed() {
            true => ExitCode::SUCCESS,
            false => ExitCode::FAILURE,
        })
    }
}

impl CostSubject {
    /// The list of subjects that was asked for in place of a graph.
    #[must_use]
    pub fn list(&self) -> SubjectList {
        match (self.summed_area_table, self.scattering) {
            (true, _) => TABLES,
            (_, true) => NODES,
            _ => BLURS,
        }
    }
}

/// Times every pass of a graph on its own, on what the options and the file say, and says how long its bytes take with each of the
/// memories at least: by default three cards.
pub fn graph(
    path: &Path,
    options: &RenderOptions,
    rounds: u32,
    memories: Vec<Memory>,
) -> Result<GraphCost, LabError> {
    let file = options.graph(path, None)?;
    let drawn = options.drawn(&file)?;
    let gpu = Gpu::open_with(file.profile(drawn.samples), FEATURES)?;
    let scene = scene::load(&options.scene)?;
    let margin = file.radius()?;
    eprintln!("{drawn}");
    let frame = options.frame(&gpu, &scene, &drawn, margin)?;
    let (cases, bytes) = cases(&gpu, &frame, &file)?;
    let clock = Clock::new(&gpu, ClockKind::for_device(&gpu));
    let bar = progress::bar(u64::from(rounds), "timing");
    let measured = Measured::of(&clock, &cases, rounds, || bar.inc(1))?;
    bar.finish_and_clear();
    let memories = match memories.is_empty() {
        true => Memory::known(),
        false => memories,
    };
    let conditions = Conditions::of(&clock, rounds);
    Ok(GraphCost::new(conditions, measured, bytes, memories))
}

/// The size of the picture that hard shadows are timed in.
const PICTURE: [u32; 2] = [1920, 1080];

/// Times hard shadows in turn and judges them, with a map of `size` texels per side.
pub fn hard_shadows(size: u32, rounds: u32) -> Result<Vec<Report<HardErrors>>, LabError> {
    let candidates = candidates()?;
    let gpu = Gpu::open_with(PROFILE, FEATURES)?;
    let drawn = Drawn {
        map: [size; 2],
        picture: PICTURE,
        ..Drawn::default()
    };
    let options = compare::Options {
        scene: scene::PROCEDURAL.map(str::to_owned).to_vec(),
        cost: Some(rounds),
        ..compare::Options::default()
    };
    compare(&gpu, &options, candidates, |scene| {
        HardStage::new(&gpu, scene, drawn)
    })
}

/// Checks and times a list of subjects, at its sizes up to the `largest`.
pub fn table(list: &SubjectList, largest: u32, rounds: u32) -> Result<CostTable, LabError> {
    let gpu = Gpu::open_with(PROFILE, FEATURES)?;
    let clock = Clock::new(&gpu, ClockKind::for_device(&gpu));
    let sizes = match list.sizes {
        [] => vec![largest],
        sizes => sizes
            .iter()
            .copied()
            .filter(|&size| size <= largest)
            .collect(),
    };
    let bar = progress::bar(
        u64::from(rounds) * sizes.len() as u64,
        "checking and timing",
    );
    let mut rows = Vec::new();
    for size in sizes {
        let cases = (list.cases)(&gpu, size)?;
        rows.extend(Measured::of(&clock, &cases, rounds, || bar.inc(1))?.rows);
    }
    bar.finish_and_clear();
    Ok(CostTable::new(
        Conditions::of(&clock, rounds),
        list.title,
        rows,
    ))
}
