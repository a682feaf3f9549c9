//! `moment-shadows layers-figure`: layered variance shadow maps against convolution shadow maps of as many bits (Lauritzen,
//! thesis 2008, figure 4.5).

use core::fmt;
use std::path::{Path, PathBuf};

use moment_shadows::{Finite, LayerSplits, MapEncoding, Storage, Technique, TechniqueError};
use serde::Serialize;

use super::error::{ErrorSubject, GraphErrors, Setting, storage_name};
use super::render::{RenderOptions, profile_for};
use crate::candidate::Candidate;
use crate::error::LabError;
use crate::error_plot::{ErrorPanel, ErrorPlot, ErrorPoint, ErrorSeries};
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::progress;
use crate::scene;
use crate::techniques::described;

/// The layers of the figure. A convolution shadow map of the same memory has twice as many terms.
const LAYERS: [u32; 4] = [2, 4, 6, 8];

/// How far layers reach beyond their splits, in moment depth.
const OVERLAP: f32 = 0.02;

/// The figure on one scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LayersFigure {
    /// The scene's name.
    pub scene: String,
    /// How it was measured.
    pub setting: Setting,
    /// Of the Gaussian, in texels.
    pub radius: u32,
    /// Layered variance shadow maps in unorm16, of 64 to 256 bits per texel.
    pub layered: Vec<GraphErrors>,
    /// Convolution shadow maps in rgba8 of the same bits, as lower bounds.
    pub convolution: Vec<GraphErrors>,
    /// The same as the plain series.
    pub series: Vec<GraphErrors>,
    /// Files that were written.
    pub plots: Vec<PathBuf>,
}

/// Measures the figure on the scene of `options` with a Gaussian of `radius` texels. Of the map's texels every `stride`-th
/// along either axis counts.
pub fn run(
    options: &RenderOptions,
    graph: &Path,
    radius: u32,
    stride: u32,
) -> Result<LayersFigure, LabError> {
    let [layered, convolution, series] = curves()?;
    let profile = profile_for(None, options.samples);
    let profile = layered
        .iter()
        .chain(&convolution)
        .fold(profile, |profile, candidate| {
            candidate.profile_with(profile)
        });
    let gpu = Gpu::open(profile)?;
    let file = GraphFile::read(graph, None)?.with_radius(radius)?;
    let scene = scene::load(&options.scene)?;
    let steps = ErrorSubject::steps(options) + 3 * LAYERS.len() as u64;
    let bar = progress::bar(steps, "measuring surfaces");
    let files = core::slice::from_ref(&file);
    let subjects = ErrorSubject::of_kernels(&gpu, &scene, options, files, stride, || bar.inc(1))?;
    let judge = |candidates: &[Candidate]| {
        let mut errors = Vec::new();
        for subject in &subjects {
            for candidate in candidates {
                errors.push(subject.judge(&gpu, &candidate.graph(&file)?, None)?);
                bar.inc(1);
            }
        }
        Ok::<_, LabError>(errors)
    };
    let figure = LayersFigure {
        scene: scene.name.clone(),
        setting: Setting::of(&gpu, graph, options),
        radius,
        layered: judge(&layered)?,
        convolution: judge(&convolution)?,
        series: judge(&series)?,
        plots: Vec::new(),
    };
    bar.finish_and_clear();
    Ok(figure)
}

/// The candidates of the three curves.
fn curves() -> Result<[Vec<Candidate>; 3], TechniqueError> {
    let candidate =
        |technique, storage| MapEncoding::new(technique, storage).map(Candidate::Filterable);
    let layered = LAYERS.map(|layers| {
        let technique = Technique::Lvsm {
            layers,
            overlap: Finite::new(OVERLAP).unwrap_or_default(),
            splits: LayerSplits::Uniform,
        };
        candidate(technique, Storage::Unorm16)
    });
    let convolution = |lower_bound| {
        LAYERS.map(|layers| {
            let technique = Technique::Convolution {
                terms: 2 * layers,
                lower_bound,
            };
            candidate(technique, Storage::Unorm8)
        })
    };
    let all = |curve: [Result<Candidate, TechniqueError>; 4]| -> Result<Vec<_>, _> {
        curve.into_iter().collect()
    };
    Ok([
        all(layered)?,
        all(convolution(true))?,
        all(convolution(false))?,
    ])
}

impl LayersFigure {
    /// Plots the figure into a folder.
    pub fn plot(&mut self, folder: &Path) -> Result<(), LabError> {
        let curve = |name: &str, errors: &[GraphErrors]| ErrorSeries {
            name: name.to_owned(),
            points: errors
                .iter()
                .map(|errors| ErrorPoint {
                    bits: errors.bits_per_texel,
                    percent: 100.0 * errors.surfaces.shading.mean_absolute,
                    storage: errors.storage,
                })
                .collect(),
        };
        let plot = ErrorPlot {
            title: "Layered variance against convolution at equal memory".to_owned(),
            setting: format!(
                "2, 4, 6, 8 layers; 4, 8, 12, 16 terms; map {0}x{0}, {1} samples per texel",
                self.setting.map, self.setting.samples
            ),
            panels: vec![ErrorPanel {
                title: format!("{}, radius {}", self.scene, self.radius),
                series: vec![
                    curve("layered variance", &self.layered),
                    curve("convolution, bound", &self.convolution),
                    curve("convolution, series", &self.series),
                ],
            }],
        };
        self.plots.extend(plot.save(folder, "layers-figure")?);
        Ok(())
    }
}

impl fmt::Display for LayersFigure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.setting)?;
        writeln!(
            f,
            "{}, radius {}: mean absolute error of shadow intensity in percent over all surfaces on rays that meet a caster\n",
            self.scene, self.radius
        )?;
        writeln!(
            f,
            "| technique | storage | bits | error | leaking | too dark | facing |"
        )?;
        writeln!(f, "|---|---|---|---|---|---|---|")?;
        let curves = [&self.layered, &self.convolution, &self.series];
        for errors in curves.into_iter().flatten() {
            let shading = &errors.surfaces.shading;
            writeln!(
                f,
                "| {} | {} | {} | {:.3} | {:.3} | {:.3} | {:.3} |",
                described(&errors.technique),
                storage_name(errors.storage),
                errors.bits_per_texel,
                100.0 * shading.mean_absolute,
                100.0 * shading.leaking,
                100.0 * shading.overdarkening,
                100.0 * errors.surfaces.shading_facing.mean_absolute
            )?;
        }
        for plot in &self.plots {
            writeln!(f, "{}", plot.display())?;
        }
        Ok(())
    }
}
