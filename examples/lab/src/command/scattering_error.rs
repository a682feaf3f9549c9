//! `moment-shadows scattering-error`: light in the air against marched rays, with pictures and costs.

use std::path::{Path, PathBuf};
use std::time::Instant;

use moment_shadows_graph::nodes::Overestimation;

use crate::cost::CostError;
use crate::cost::clock::{Clock, ClockKind, FEATURES};
use crate::cost::protocol::FEWEST_ROUNDS;
use crate::cost::report::Conditions;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;
use crate::picture::{PictureError, save_atomically, save_panels, save_rgba, signed_difference};
use crate::progress;
use crate::scattering::{
    PROFILE, ScatteringCandidate, ScatteringError, ScatteringReport, ScatteringRow,
    ScatteringStage, ScatteringStageDesc, candidates, costs,
};
use crate::scene;

/// What to compare.
#[derive(Clone, Debug, PartialEq)]
pub struct ScatteringErrorOptions {
    /// Viewpoint, medium, map and picture.
    pub stage: ScatteringStageDesc,
    /// Columns and rows of rectified maps.
    pub extent: [u32; 2],
    /// How strongly our nodes lean towards a bound.
    pub overestimation: Overestimation,
    /// Only candidates with one of these names, unless empty.
    pub only: Vec<String>,
    /// Rounds of measuring costs; none of them, no costs.
    pub rounds: Option<u32>,
    /// A folder for pictures.
    pub out: Option<PathBuf>,
}

/// A difference that is shown in full colour, in parts of the mean radiance without shadows.
const FULL_DIFFERENCE: f32 = 0.5;

/// What the mean radiance without shadows is in pictures, on a scale from black to white.
const EXPOSURE: f64 = 0.35;

/// The chain that lights the surfaces of pictures.
const SURFACES: &str = include_str!("../../../hard_shadows.json");

/// Judges all candidates on each scene: glTF files or names of procedural scenes.
pub fn run(
    scenes: &[String],
    options: &ScatteringErrorOptions,
) -> Result<Vec<ScatteringReport>, CostError> {
    let gpu = Gpu::open_with(PROFILE, FEATURES)?;
    let mut candidates = candidates(
        &gpu,
        options.stage.radius,
        options.extent,
        options.overestimation,
    )?;
    let known: Vec<String> = candidates.iter().map(|it| it.name.clone()).collect();
    for name in &options.only {
        if !known.contains(name) {
            return Err(CostError::Lab(LabError::Unsuitable {
                file: name.clone(),
                reason: format!(
                    "nothing of this name is compared; there are {}",
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
    scenes
        .iter()
        .map(|name| judge(&gpu, name, options, &candidates))
        .collect()
}

fn judge(
    gpu: &Gpu,
    name: &str,
    options: &ScatteringErrorOptions,
    candidates: &[ScatteringCandidate],
) -> Result<ScatteringReport, CostError> {
    let bar = progress::bar(candidates.len() as u64 + 1, name);
    let scene = scene::load(name).map_err(LabError::from)?;
    let desc = &options.stage;
    let begun = Instant::now();
    let stage = ScatteringStage::new(gpu, &scene, desc)?;
    let truth_seconds = begun.elapsed().as_secs_f64();
    bar.inc(1);
    let mut rows = Vec::new();
    let mut pictures = Vec::new();
    let mut bound = Vec::new();
    for candidate in candidates {
        let candidate_bound = candidate.bind(gpu, &stage)?;
        let picture = candidate_bound.picture(gpu)?;
        rows.push(ScatteringRow {
            name: candidate.name.clone(),
            ours: candidate.is_ours(),
            fetches: candidate.fetches,
            plain: ScatteringError::of(&picture, &stage.truth),
            filtered: ScatteringError::of(&picture, &stage.filtered),
            steps: candidate.steps(),
            cost: None,
        });
        pictures.push(picture);
        bound.push((candidate.name.as_str(), candidate_bound));
        bar.inc(1);
    }
    bar.finish_and_clear();
    let pixels = stage.truth.unshadowed.len().max(1) as f64;
    let mean = |values: &[[f32; 3]]| {
        [0, 1, 2].map(|colour| {
            let sum: f64 = values.iter().map(|value| f64::from(value[colour])).sum();
            sum / pixels
        })
    };
    let (unshadowed, lit) = (mean(&stage.truth.unshadowed), mean(&stage.truth.radiance));
    if let Some(out) = &options.out {
        let stem = out.join(format!("{}-{}", scene.name, desc.look.look.name()));
        let brightness = unshadowed.iter().sum::<f64>() / 3.0;
        save(gpu, &stem, &stage, candidates, &pictures, brightness)?;
    }
    let mut conditions = None;
    if let Some(rounds) = options.rounds {
        let clock = Clock::new(gpu, ClockKind::for_device(gpu));
        let bar = progress::bar(u64::from(rounds.max(FEWEST_ROUNDS)), "timing");
        let costs = costs(&clock, &stage, &bound, rounds, || bar.inc(1))?;
        bar.finish_and_clear();
        for (row, cost) in rows.iter_mut().zip(costs) {
            row.cost = Some(cost);
        }
        conditions = Some(Conditions::of(&clock, rounds));
    }
    Ok(ScatteringReport {
        scene: scene.name,
        look: desc.look.look.name(),
        map: desc.map,
        extent: options.extent,
        picture: desc.picture,
        steps: desc.steps,
        thickness: desc.thickness,
        unshadowed,
        shadowed: 1.0 - lit.iter().sum::<f64>() / unshadowed.iter().sum::<f64>().max(1e-300),
        truth_seconds,
        rows,
        conditions,
    })
}

/// Saves the truth, every candidate with its difference, and all of them side by side: `STEM-truth.png`, `STEM-NAME.png`,
/// `STEM-NAME-difference.png`, `STEM.png`.
fn save(
    gpu: &Gpu,
    stem: &Path,
    stage: &ScatteringStage,
    candidates: &[ScatteringCandidate],
    pictures: &[Vec<[f32; 4]>],
    brightness: f64,
) -> Result<(), LabError> {
    let named = |what: &str| {
        let mut path = stem.as_os_str().to_owned();
        path.push(what);
        PathBuf::from(path)
    };
    let frame = stage.frame();
    let [width, height] = frame.desc.picture;
    let surfaces = {
        let file = GraphFile::parse("hard_shadows.json", SURFACES.to_owned(), None)?;
        let graph = GraphFrame::new(gpu, frame, &file)?;
        graph.run(gpu)?;
        frame.picture(gpu, graph.shadow(&file)?)?
    };
    let exposure = EXPOSURE / brightness;
    // The truth has no alpha; that of any candidate is exact.
    let dimming: Vec<f32> = pictures.first().map_or(Vec::new(), |picture| {
        picture.iter().map(|pixel| pixel[3]).collect()
    });
    let truth: Vec<[f32; 4]> = (stage.truth.radiance.iter().zip(&dimming))
        .map(|(&[red, green, blue], &dimming)| [red, green, blue, dimming])
        .collect();
    let grey = |picture: &[[f32; 4]]| -> Vec<f32> {
        let mean = |pixel: &[f32; 4]| (pixel[0] + pixel[1] + pixel[2]) / 3.0;
        (picture.iter().map(mean))
            .map(|mean| mean / brightness as f32)
            .collect()
    };
    let mut panels = vec![lit(&surfaces, &truth, exposure)];
    let mut differences = vec![vec![255; panels[0].len()]];
    for picture in pictures {
        panels.push(lit(&surfaces, picture, exposure));
        // Too bright is blue, as too little shadow is.
        differences.push(signed_difference(
            &grey(&truth),
            &grey(picture),
            FULL_DIFFERENCE,
        ));
    }
    save_rgba(&named("-truth.png"), width, height, &panels[0])?;
    for (candidate, (panel, difference)) in
        (candidates.iter()).zip(panels[1..].iter().zip(&differences[1..]))
    {
        let name = candidate.file_stem();
        save_rgba(&named(&format!("-{name}.png")), width, height, panel)?;
        let path = named(&format!("-{name}-difference.png"));
        save_rgba(&path, width, height, difference)?;
    }
    let all = [panels.as_slice(), &differences].concat();
    save_panels(&named(".png"), &all, [width, height], panels.len() as u32)?;
    Ok(())
}

/// Radiance in front of a picture of sRGB bytes.
fn lit(surfaces: &[u8], radiance: &[[f32; 4]], exposure: f64) -> Vec<u8> {
    let mut picture = surfaces.to_vec();
    for (pixel, light) in picture.chunks_exact_mut(4).zip(radiance) {
        for (byte, &colour) in pixel.iter_mut().zip(&light[..3]) {
            let behind = (f64::from(*byte) / 255.0).powf(2.2) * f64::from(light[3]);
            let sum = behind + exposure * f64::from(colour);
            *byte = (sum.clamp(0.0, 1.0).powf(1.0 / 2.2) * 255.0).round() as u8;
        }
    }
    picture
}

/// Writes the reports as JSON.
pub fn save_json(path: &Path, reports: &[ScatteringReport]) -> Result<(), PictureError> {
    save_atomically(path, |file| {
        serde_json::to_writer_pretty(&mut *file, reports)?;
        file.write_all(b"\n")
    })
}
