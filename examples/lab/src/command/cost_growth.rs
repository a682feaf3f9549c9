//! `moment-shadows cost-growth`: how the cost of a graph's nodes grows, measured and plotted.

use std::path::Path;

use super::render::RenderOptions;
use crate::cost::CostError;
use crate::cost::blur::PROFILE;
use crate::cost::clock::{Clock, ClockKind, FEATURES};
use crate::cost::growth::{Axis, CostGrowth, Growth, Value};
use crate::cost::passes::{Grouping, PassSubjects};
use crate::cost::plot;
use crate::cost::protocol::{FEWEST_ROUNDS, Rounds};
use crate::cost::report::Conditions;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::picture::PictureError;
use crate::progress;
use crate::scene::{self, Scene};

/// The values that are measured; an axis without any is left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GrowthOptions {
    /// Texels per side of the light's map.
    pub map_sizes: Vec<u32>,
    /// Widths of the picture, whose height is 9/16 of it.
    pub widths: Vec<u32>,
    /// Radii of the Gaussian, in texels.
    pub radii: Vec<u32>,
    /// Rounds, at least 9.
    pub rounds: u32,
}

/// A value of an axis: the graph and the frame that have it, and the types of the nodes that depend on it.
struct Setting {
    value: Value,
    file: GraphFile,
    options: RenderOptions,
    nodes: &'static [&'static str],
}

/// All nodes depend on the size of the map: shading by the caches.
const ALL: &[&str] = &["resolve", "blur", "downsample", "shade_hard"];

/// Measures the graph along all axes and plots each into the folder `out` as soon as it is done. All values of an axis
/// are timed in the same rounds, after what they give has been found right.
pub fn run(graph: &Path, out: &Path, options: &GrowthOptions) -> Result<CostGrowth, CostError> {
    let gpu = Gpu::open_with(PROFILE, FEATURES)?;
    let scene = scene::load(&RenderOptions::default().scene).map_err(LabError::from)?;
    std::fs::create_dir_all(out).map_err(|source| PictureError::Unwritable {
        path: out.to_owned(),
        source,
    })?;
    let settings = [
        (Axis::MapSize, map_sizes(graph, options)?),
        (Axis::OutputSize, widths(graph, options)?),
        (Axis::Radius, radii(graph, options)?),
    ];
    let clock = Clock::new(&gpu, ClockKind::for_device(&gpu));
    let conditions = Conditions::of(&clock, options.rounds);
    let mut growths = Vec::new();
    let mut plots = Vec::new();
    for (axis, settings) in settings {
        if settings.is_empty() {
            continue;
        }
        let growth = measure(&gpu, &scene, &clock, axis, settings, options.rounds)?;
        for path in plot::save(&growth, &conditions, out)? {
            plots.push(path.display().to_string());
        }
        growths.push(growth);
    }
    Ok(CostGrowth {
        conditions,
        growths,
        plots,
    })
}

fn measure(
    gpu: &Gpu,
    scene: &Scene,
    clock: &Clock<'_>,
    axis: Axis,
    settings: Vec<Setting>,
    rounds: u32,
) -> Result<Growth, CostError> {
    let steps = settings.len() as u64 + u64::from(rounds.max(FEWEST_ROUNDS));
    let bar = progress::bar(steps, axis.label());
    let mut measured = Vec::new();
    for setting in settings {
        let margin = setting.file.kernel()?.map_or(0, |kernel| kernel.radius());
        let frame = setting.options.frame(gpu, scene, margin)?;
        let wanted = |node_type: &str| setting.nodes.contains(&node_type);
        let subjects = PassSubjects::new(gpu, &frame, &setting.file, Grouping::Nodes, wanted)?;
        measured.push((setting.value, subjects));
        bar.inc(1);
    }
    let subjects: Vec<_> = measured
        .iter()
        .flat_map(|(_, subjects)| subjects.subjects())
        .collect();
    let times = Rounds::run(clock, &subjects, rounds, || bar.inc(1))?;
    bar.finish_and_clear();
    Ok(Growth::of(axis, &measured, &times))
}

fn map_sizes(graph: &Path, options: &GrowthOptions) -> Result<Vec<Setting>, CostError> {
    let setting = |&side: &u32| {
        Ok(Setting {
            value: value(f64::from(side), side.to_string()),
            file: GraphFile::read(graph, None)?,
            options: RenderOptions {
                map: side,
                ..RenderOptions::default()
            },
            nodes: ALL,
        })
    };
    options.map_sizes.iter().map(setting).collect()
}

fn widths(graph: &Path, options: &GrowthOptions) -> Result<Vec<Setting>, CostError> {
    let setting = |&width: &u32| {
        let height = (width * 9 / 16).max(1);
        Ok(Setting {
            value: value(
                f64::from(width) * f64::from(height),
                format!("{width}x{height}"),
            ),
            file: GraphFile::read(graph, None)?,
            options: RenderOptions {
                size: [width, height],
                ..RenderOptions::default()
            },
            nodes: &["shade_hard"],
        })
    };
    options.widths.iter().map(setting).collect()
}

fn radii(graph: &Path, options: &GrowthOptions) -> Result<Vec<Setting>, CostError> {
    let setting = |&radius: &u32| {
        Ok(Setting {
            value: value(f64::from(radius), radius.to_string()),
            file: GraphFile::read(graph, None)?.with_radius(radius)?,
            options: RenderOptions::default(),
            nodes: &["blur"],
        })
    };
    options.radii.iter().map(setting).collect()
}

fn value(x: f64, label: String) -> Value {
    Value { x, label }
}
