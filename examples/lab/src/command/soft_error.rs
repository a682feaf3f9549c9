//! `moment-shadows soft-error`: soft shadows against a sampled area light, with pictures and costs.

use std::path::{Path, PathBuf};
use std::time::Instant;

use crate::cost::CostError;
use crate::cost::blur::PROFILE;
use crate::cost::clock::{Clock, ClockKind, FEATURES};
use crate::cost::protocol::FEWEST_ROUNDS;
use crate::cost::report::Conditions;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::picture::{PictureError, save_atomically, save_panels, save_rgba, signed_difference};
use crate::progress;
use crate::scene;
use crate::soft::{
    NamedGraph, SoftCandidate, SoftEdges, SoftReport, SoftRow, SoftStage, StageDesc, candidates,
    costs, size,
};

/// What to compare.
#[derive(Clone, Debug, PartialEq)]
pub struct SoftErrorOptions {
    /// Light, map and picture.
    pub stage: StageDesc,
    /// Graphs beside hard and percentage closer soft shadows.
    pub graphs: Vec<NamedGraph>,
    /// Only candidates with one of these names, unless empty.
    pub only: Vec<String>,
    /// Rounds of measuring costs; none of them, no costs.
    pub rounds: Option<u32>,
    /// A folder for pictures.
    pub out: Option<PathBuf>,
}

/// A difference of shadow intensity that is shown in full colour.
const FULL_DIFFERENCE: f32 = 0.5;

/// Judges all candidates on each scene: glTF files or names of procedural scenes.
pub fn run(scenes: &[String], options: &SoftErrorOptions) -> Result<Vec<SoftReport>, CostError> {
    let mut candidates = candidates(&options.graphs)?;
    let known: Vec<String> = candidates.iter().map(|it| it.name.clone()).collect();
    for name in &options.only {
        if !known.contains(name) {
            return Err(CostError::Lab(LabError::Unsuitable {
                file: name.clone(),
                reason: format!(
                    "no technique of this name is compared; there are {}",
                    known.join(", ")
                ),
            }));
        }
    }
    candidates.retain(|it| options.only.is_empty() || options.only.contains(&it.name));
    if let Some(out) = &options.out {
        std::fs::create_dir_all(out).map_err(|source| PictureError::Unwritable {
            path: out.clone(),
            source,
        })?;
    }
    let gpu = Gpu::open_with(PROFILE, FEATURES)?;
    scenes
        .iter()
        .map(|name| judge(&gpu, name, options, &candidates))
        .collect()
}

fn judge(
    gpu: &Gpu,
    name: &str,
    options: &SoftErrorOptions,
    candidates: &[SoftCandidate],
) -> Result<SoftReport, CostError> {
    let bar = progress::bar(candidates.len() as u64 + 1, name);
    let scene = scene::load(name).map_err(LabError::from)?;
    let desc = &options.stage;
    let begun = Instant::now();
    let stage = SoftStage::new(gpu, &scene, desc)?;
    let truth_seconds = begun.elapsed().as_secs_f64();
    bar.inc(1);
    let mut rows = Vec::new();
    let mut pictures = Vec::new();
    for candidate in candidates {
        let picture = stage.picture(gpu, candidate)?;
        rows.push(SoftRow {
            name: candidate.name.clone(),
            error: stage.judge(&picture.shadow)?,
            edges: stage.widths(&picture.shadow),
            cost: None,
        });
        pictures.push(picture);
        bar.inc(1);
    }
    bar.finish_and_clear();
    if let Some(out) = &options.out {
        let mut panels = vec![stage.lit_truth(gpu)?];
        let mut differences = vec![vec![255; panels[0].len()]];
        for picture in pictures {
            let mut shadow = picture.shadow;
            // Elsewhere there is no shadow that could be wrong.
            for ((shadow, truth), judged) in shadow.iter_mut().zip(&stage.truth).zip(&stage.judged)
            {
                if !judged {
                    *shadow = *truth;
                }
            }
            panels.push(picture.lit);
            differences.push(signed_difference(&shadow, &stage.truth, FULL_DIFFERENCE));
        }
        let stem = format!("{}-{}", scene.name, desc.light.name());
        save(
            &out.join(stem),
            desc.picture,
            candidates,
            &panels,
            &differences,
        )?;
    }
    let mut conditions = None;
    if let Some(rounds) = options.rounds {
        let clock = Clock::new(gpu, ClockKind::for_device(gpu));
        let bar = progress::bar(u64::from(rounds.max(FEWEST_ROUNDS)), "timing");
        let costs = costs(&clock, &stage, candidates, rounds, || bar.inc(1))?;
        bar.finish_and_clear();
        for (row, cost) in rows.iter_mut().zip(costs) {
            row.cost = Some(cost);
        }
        conditions = Some(Conditions::of(&clock, rounds));
    }
    let drawn = stage.desc();
    let edges = stage.exact_widths().zip(stage.widths(&stage.truth));
    Ok(SoftReport {
        scene: scene.name,
        light: desc.light,
        light_size: size(drawn.shape),
        light_range: drawn.light.range,
        texel: drawn.light.texel_size(drawn.map),
        map: desc.map,
        picture: desc.picture,
        places: desc.places,
        truth_seconds,
        edges: edges.map(|(exact, truth)| SoftEdges { exact, truth }),
        rows,
        conditions,
    })
}

/// Saves the truth, every candidate with its difference, and all of them side by side: `STEM-truth.png`, `STEM-NAME.png`,
/// `STEM-NAME-difference.png`, `STEM.png`.
fn save(
    stem: &Path,
    [width, height]: [u32; 2],
    candidates: &[SoftCandidate],
    panels: &[Vec<u8>],
    differences: &[Vec<u8>],
) -> Result<(), PictureError> {
    let named = |what: &str| {
        let mut path = stem.as_os_str().to_owned();
        path.push(what);
        PathBuf::from(path)
    };
    save_rgba(&named("-truth.png"), width, height, &panels[0])?;
    let of_candidates = panels[1..].iter().zip(&differences[1..]);
    for (candidate, (lit, difference)) in candidates.iter().zip(of_candidates) {
        let name = candidate.file_stem();
        save_rgba(&named(&format!("-{name}.png")), width, height, lit)?;
        let difference_path = named(&format!("-{name}-difference.png"));
        save_rgba(&difference_path, width, height, difference)?;
    }
    let all = [panels, differences].concat();
    save_panels(&named(".png"), &all, [width, height], panels.len() as u32)
}

/// Writes the reports as JSON.
pub fn save_json(path: &Path, reports: &[SoftReport]) -> Result<(), PictureError> {
    save_atomically(path, |file| {
        serde_json::to_writer_pretty(&mut *file, reports)?;
        file.write_all(b"\n")
    })
}
