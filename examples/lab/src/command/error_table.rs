//! `moment-shadows error-table`: the error over all surfaces of scenes, for techniques, storages and radii.

mod average;

use core::fmt;
use std::path::{Path, PathBuf};

use serde::Serialize;

pub use average::error_plot;

use super::error::{ErrorSubject, GraphErrors, Setting, storage_name};
use super::render::{RenderOptions, profile_for};
use crate::candidate::Candidate;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::progress;
use crate::scene;
use crate::techniques::described;

/// What is measured.
#[derive(Clone, Debug)]
pub struct TableOptions {
    /// glTF files or names of procedural scenes.
    pub scenes: Vec<String>,
    /// Of the Gaussian, in texels.
    pub radii: Vec<u32>,
    /// What the graph is measured with.
    pub candidates: Vec<Candidate>,
    /// Of the map's texels every one of so many along either axis counts.
    pub stride: u32,
    /// The light, its map and the picture.
    pub render: RenderOptions,
}

/// One scene, radius, technique and storage.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ErrorRow {
    /// The scene's name.
    pub scene: String,
    /// Of the Gaussian, in texels.
    pub radius: u32,
    /// The figures.
    pub errors: GraphErrors,
}

/// All rows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ErrorTable {
    /// How they were measured.
    pub setting: Setting,
    /// Of the map's texels every one of so many along either axis counts.
    pub stride: u32,
    /// Scene by scene, radius by radius, in the order of the candidates.
    pub rows: Vec<ErrorRow>,
    /// Files that were written.
    pub plots: Vec<PathBuf>,
}

/// Measures every scene with every radius and every candidate. A scene is peeled once, with room for the widest kernel.
pub fn run(graph: &Path, options: &TableOptions) -> Result<ErrorTable, LabError> {
    let profile = profile_for(None, options.render.samples);
    let profile = options
        .candidates
        .iter()
        .fold(profile, |profile, candidate| {
            candidate.profile_with(profile)
        });
    let gpu = Gpu::open(profile)?;
    let file = GraphFile::read(graph, None)?;
    let files: Vec<GraphFile> = options
        .radii
        .iter()
        .map(|&radius| file.with_radius(radius))
        .collect::<Result<_, _>>()?;
    let rows_of_scene = (files.len() * options.candidates.len()) as u64;
    let steps = ErrorSubject::steps(&options.render) + rows_of_scene;
    let bar = progress::bar(options.scenes.len() as u64 * steps, "measuring surfaces");
    let mut rows = Vec::new();
    for name in &options.scenes {
        let scene = scene::load(name)?;
        let (render, stride) = (&options.render, options.stride);
        let subjects =
            ErrorSubject::of_kernels(&gpu, &scene, render, &files, stride, || bar.inc(1))?;
        let plain = if options.candidates.iter().any(Candidate::reads_depth) {
            Some(ErrorSubject::plain_frame(&gpu, &scene, render, &files)?)
        } else {
            None
        };
        for ((subject, file), &radius) in subjects.iter().zip(&files).zip(&options.radii) {
            for candidate in &options.candidates {
                let plain = plain.as_ref().filter(|_| candidate.reads_depth());
                let frame = plain.unwrap_or(&subject.frame);
                let errors = subject.judge_on(&gpu, frame, &candidate.graph(file)?, None)?;
                rows.push(ErrorRow {
                    scene: scene.name.clone(),
                    radius,
                    errors,
                });
                bar.inc(1);
            }
        }
    }
    bar.finish_and_clear();
    Ok(ErrorTable {
        setting: Setting::of(&gpu, graph, &options.render),
        stride: options.stride,
        rows,
        plots: Vec::new(),
    })
}

impl ErrorTable {
    /// Plots the errors against the bits of a texel into a folder.
    pub fn plot(&mut self, folder: &Path) -> Result<(), LabError> {
        let plot = error_plot(&self.rows, &self.setting);
        self.plots.extend(plot.save(folder, "error-table")?);
        Ok(())
    }
}

impl fmt::Display for ErrorTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.setting)?;
        if self.stride > 1 {
            writeln!(
                f,
                "One ray for every {0}x{0} texels of the map.",
                self.stride
            )?;
        }
        writeln!(
            f,
            "Mean absolute error of shadow intensity in percent, over all surfaces on rays that meet a caster (facing: over those \
             that face the light; distribution: of the moments alone; picture: over facing pixels).\n"
        )?;
        writeln!(
            f,
            "| scene | radius | technique | storage | bits | surfaces | peels | error | leaking | too dark | 95 % | maximum | facing | distribution | picture |"
        )?;
        writeln!(
            f,
            "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
        )?;
        for ErrorRow {
            scene,
            radius,
            errors,
        } in &self.rows
        {
            let shading = &errors.surfaces.shading;
            write!(
                f,
                "| {scene} | {radius} | {} | {} | {} | {} | {} |",
                described(&errors.technique),
                storage_name(errors.storage),
                errors.bits_per_texel,
                shading.samples,
                errors.surfaces.peels
            )?;
            for error in [
                shading.mean_absolute,
                shading.leaking,
                shading.overdarkening,
                shading.percentile_95,
                shading.maximum,
                errors.surfaces.shading_facing.mean_absolute,
                errors.surfaces.distribution.mean_absolute,
                errors.picture.facing.mean_absolute,
            ] {
                write!(f, " {:.3} |", 100.0 * error)?;
            }
            writeln!(f)?;
        }
        for plot in &self.plots {
            writeln!(f, "{}", plot.display())?;
        }
        Ok(())
    }
}
