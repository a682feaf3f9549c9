//! `moment-shadows cost`: what passes cost, as ratios to copies, and in bytes.

use std::path::Path;

use moment_shadows::Storage;
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::nodes::KernelProperty;

use super::render::RenderOptions;
use crate::cost::CostError;
use crate::cost::bandwidth::Memory;
use crate::cost::baseline::{Copies, CopyWork};
use crate::cost::blur::{BOUNDS, BlurredMap, PROFILE};
use crate::cost::clock::{Clock, ClockKind, FEATURES};
use crate::cost::graph_cost::GraphCost;
use crate::cost::passes::{Grouping, PassSubjects};
use crate::cost::protocol::{CopyNumbers, Rounds, Subject};
use crate::cost::report::{BlurCost, BlurRow, Conditions};
use crate::cost::scattering::{self, ScatteringCost};
use crate::cost::summed_area::{self, SIZES, TableCost};
use crate::cost::texels::noise;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::progress;
use crate::scene;

/// Times every pass of a graph on its own, on a scene with a light's map of `size` texels squared, and says how long its
/// bytes take with each of the memories at least.
pub fn graph(
    path: &Path,
    size: u32,
    rounds: u32,
    memories: Vec<Memory>,
) -> Result<GraphCost, CostError> {
    let file = GraphFile::read(path, None)?;
    let gpu = Gpu::open_with(PROFILE, FEATURES)?;
    let options = RenderOptions {
        map: size,
        ..RenderOptions::default()
    };
    let scene = scene::load(&options.scene).map_err(crate::error::LabError::from)?;
    let margin = file.kernel()?.map_or(0, |kernel| kernel.radius());
    let frame = options.frame(&gpu, &scene, margin)?;
    let passes = PassSubjects::new(&gpu, &frame, &file, Grouping::Passes, |_| true)?;
    let clock = Clock::new(&gpu, ClockKind::for_device(&gpu));
    let bar = progress::bar(u64::from(rounds), "timing");
    let times = Rounds::run(&clock, &passes.subjects(), rounds, || bar.inc(1))?;
    bar.finish_and_clear();
    let plan = passes.plan();
    Ok(GraphCost::new(
        Conditions::of(&clock, rounds),
        passes.costs(&times),
        times.total(&passes.numbers(0)),
        [plan.bytes_resident(), plan.bytes_moved()],
        memories,
    ))
}

/// Times summed-area tables of maps of up to `largest` texels squared, made by the node and the usual way.
pub fn summed_area_table(largest: u32, rounds: u32) -> Result<TableCost, CostError> {
    let gpu = Gpu::open_with(PROFILE, FEATURES)?;
    let clock = Clock::new(&gpu, ClockKind::for_device(&gpu));
    let sizes = SIZES.into_iter().filter(|&size| size <= largest);
    let bar = progress::bar(sizes.clone().count() as u64, "checking and timing");
    let mut rows = Vec::new();
    for size in sizes {
        rows.extend(summed_area::rows(&gpu, &clock, size, rounds)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    let conditions = Conditions::of(&clock, rounds);
    Ok(TableCost::new(conditions, rows, clock.kind()))
}

/// Times the nodes of single scattering on maps of up to `largest` texels squared.
pub fn scattering(largest: u32, rounds: u32) -> Result<ScatteringCost, CostError> {
    let gpu = Gpu::open_with(PROFILE, FEATURES)?;
    let clock = Clock::new(&gpu, ClockKind::for_device(&gpu));
    let sizes = scattering::SIZES
        .into_iter()
        .filter(|&size| size <= largest);
    let bar = progress::bar(sizes.clone().count() as u64, "checking and timing");
    let mut rows = Vec::new();
    for size in sizes {
        rows.extend(scattering::rows(&gpu, &clock, size, rounds)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(ScatteringCost::new(Conditions::of(&clock, rounds), rows))
}

/// The numbers of the copies beside the blurs.
const COPIES: CopyNumbers = CopyNumbers {
    compute: 0,
    api: 1,
    draw: None,
};

/// Times blurs of a map of `size` texels squared, both directions together, against their bounds.
pub fn blur(size: u32, rounds: u32) -> Result<BlurCost, CostError> {
    let storage = Storage::Unorm16;
    let gpu = Gpu::open_with(PROFILE, FEATURES)?;
    let channels = noise(storage, size as usize * size as usize);
    let bar = progress::bar(u64::from(rounds) + BOUNDS.len() as u64, "checking");
    let mut blurs = Vec::new();
    for bound in BOUNDS {
        let kernel = KernelProperty {
            radius: Some(bound.radius),
            ..KernelProperty::default()
        };
        let blurred = BlurredMap::new(&gpu, storage, [size; 2], &channels, kernel, false)?;
        let error = blurred.check(&gpu, &channels)?;
        blurs.push((bound, blurred, error));
        bar.inc(1);
    }
    bar.set_message("timing");
    let desc = TextureDesc::new(storage.format(), [size; 2]);
    let copies = Copies::new(&gpu, &desc, CopyWork::Compute)?;
    let mut subjects = vec![
        Subject {
            name: "compute copy".to_owned(),
            record: copies.by_shader(),
        },
        Subject {
            name: "interface copy".to_owned(),
            record: copies.by_interface(),
        },
    ];
    subjects.extend(blurs.iter().map(|(bound, blurred, _)| Subject {
        name: format!("blur of radius {}", bound.radius),
        record: Box::new(|encoder| blurred.record(encoder)),
    }));
    let clock = Clock::new(&gpu, ClockKind::for_device(&gpu));
    let times = Rounds::run(&clock, &subjects, rounds, || bar.inc(1))?;
    bar.finish_and_clear();
    let software = clock.kind() == ClockKind::ProcessTime;
    let rows = blurs
        .iter()
        .enumerate()
        .map(|(index, (bound, _, error))| {
            BlurRow::new(*bound, times.time(index + 2, COPIES), *error, software)
        })
        .collect();
    Ok(BlurCost {
        conditions: Conditions::of(&clock, rounds),
        size,
        rows,
    })
}
