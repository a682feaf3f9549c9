//! `moment-shadows cost-growth`: how the cost of a graph's nodes grows, measured and plotted.

use std::path::PathBuf;

use super::render::RenderOptions;
use crate::cost::blur::PROFILE;
use crate::cost::clock::{Clock, ClockKind, FEATURES};
use crate::cost::growth::{Axis, CostGrowth, Growth, Value};
use crate::cost::harness::Measured;
use crate::cost::passes::{Grouping, cases};
use crate::cost::protocol::FEWEST_ROUNDS;
use crate::cost::report::Conditions;
use crate::cost::table::Facts;
use crate::cost::{CostError, plot};
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::picture::PictureError;
use crate::progress;
use crate::scene::{self, Scene};

/// The values that are measured; an axis without any is left out.
#[derive(Clone, Debug, PartialEq, Eq, clap::Args)]
pub struct GrowthOptions {
    /// The graph file.
    pub graph: PathBuf,
    /// The folder for the plots, as SVG and PNG; it is made if need be.
    #[arg(long)]
    pub out: PathBuf,
    /// Texels per side of the light's map.
    #[arg(long = "map", value_name = "MAP", num_args = 1.., default_values = ["256", "512", "1024", "2048", "4096"], value_parser = clap::value_parser!(u32).range(64..=8192))]
    pub map_sizes: Vec<u32>,
    /// Widths of the output; heights follow at 16 to 9.
    #[arg(long = "width", value_name = "WIDTH", num_args = 1.., default_values = ["640", "1280", "1920", "2560", "3840"], value_parser = clap::value_parser!(u32).range(64..=8192))]
    pub widths: Vec<u32>,
    /// Radii of the Gaussian, in texels.
    #[arg(long = "radius", value_name = "RADIUS", num_args = 1.., default_values = ["1", "2", "4", "8", "12", "16", "32", "64"], value_parser = clap::value_parser!(u32).range(1..=64))]
    pub radii: Vec<u32>,
    /// Rounds, at least 9.
    #[arg(long, default_value_t = 15, value_parser = clap::value_parser!(u32).range(9..=1000))]
    pub rounds: u32,
    /// Prints JSON.
    #[arg(long)]
    pub json: bool,
}

/// Measures the graph along all axes and plots each into the folder `out` as soon as it is done. All values of an axis
/// are timed in the same rounds, after what they give has been found right.
pub fn run(options: &GrowthOptions) -> Result<CostGrowth, CostError> {
    let out = &options.out;
    let gpu = Gpu::open_with(PROFILE, FEATURES)?;
    let scene = scene::load(&RenderOptions::default().scene)?;
    std::fs::create_dir_all(out).map_err(|source| PictureError::Unwritable {
        path: out.clone(),
        source,
    })?;
    let clock = Clock::new(&gpu, ClockKind::for_device(&gpu));
    let mut growth = CostGrowth {
        conditions: Conditions::of(&clock, options.rounds),
        growths: Vec::new(),
        plots: Vec::new(),
    };
    let axes = [
        (Axis::MapSize, &options.map_sizes),
        (Axis::OutputSize, &options.widths),
        (Axis::Radius, &options.radii),
    ];
    for (axis, values) in axes.into_iter().filter(|(_, values)| !values.is_empty()) {
        let along = measure(&clock, &scene, axis, values, options)?;
        let plots = plot::save(&along, &growth.conditions, out)?;
        let plots = plots.map(|path| path.display().to_string());
        growth.plots.extend(plots);
        growth.growths.push(along);
    }
    Ok(growth)
}

fn measure(
    clock: &Clock<'_>,
    scene: &Scene,
    axis: Axis,
    values: &[u32],
    options: &GrowthOptions,
) -> Result<Growth, CostError> {
    // All nodes depend on the size of the map: shading by the caches.
    let wanted: &[&str] = match axis {
        Axis::MapSize => &["resolve", "blur", "downsample", "shade_hard"],
        Axis::OutputSize => &["shade_hard"],
        Axis::Radius => &["blur"],
    };
    let wanted = |node: &str| wanted.contains(&node);
    let rounds = options.rounds.max(FEWEST_ROUNDS);
    let bar = progress::bar(values.len() as u64 + u64::from(rounds), axis.texts()[1]);
    let (mut all, mut places) = (Vec::new(), Vec::new());
    for &value in values {
        let mut file = GraphFile::read(&options.graph, None)?;
        let mut frame = RenderOptions::default();
        let (mut x, mut label) = (f64::from(value), value.to_string());
        match axis {
            Axis::MapSize => frame.map = value,
            Axis::OutputSize => {
                let height = (value * 9 / 16).max(1);
                frame.size = [value, height];
                (x, label) = (x * f64::from(height), format!("{value}x{height}"));
            }
            Axis::Radius => file = file.with_radius(value)?,
        }
        let margin = file.kernel()?.map_or(0, |kernel| kernel.radius());
        let frame = frame.frame(clock.gpu(), scene, margin)?;
        let (cases, _) = cases(clock.gpu(), &frame, &file, Grouping::Nodes, wanted)?;
        for mut case in cases {
            let [node, at] = [&case.name, &label].map(|text| text.as_str().into());
            case.facts = Facts(vec![("node", node), ("at", at)]);
            all.push(case);
            let label = label.clone();
            places.push(Value { x, label });
        }
        bar.inc(1);
    }
    let measured = Measured::of(clock, &all, rounds, || bar.inc(1))?;
    bar.finish_and_clear();
    Ok(Growth::of(axis, places, &measured))
}
