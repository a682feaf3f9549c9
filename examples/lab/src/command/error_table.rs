//! `moment-shadows-lab error-table`: the error over all surfaces of scenes, for techniques, storages and radii.

mod average;

use core::fmt;
use std::path::{Path, PathBuf};

use moment_shadows::{Storage, ValueError};
use serde::Serialize;

pub use average::error_chart;

use super::error::{ErrorSubject, GraphErrors, Setting, storage_name};
use super::render::{RenderOptions, profile_for};
use super::{CommandResult, print};
use crate::candidate::{Candidate, TechniqueChoice, candidates};
use crate::cost::table::columns;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::metric::{NO_PIXEL, percent};
use crate::picture::create_folder;
use crate::progress;
use crate::techniques::described;

/// What `error-table` takes.
#[derive(clap::Args)]
pub struct Options {
    /// The light, its map and the picture.
    #[command(flatten)]
    pub frame: RenderOptions,
    /// glTF or GLB files, or procedural scenes.
    #[arg(long, num_args = 1.., default_values = ["fence-and-foliage", "hall"])]
    pub scene: Vec<String>,
    /// The graph file.
    #[arg(long)]
    pub graph: PathBuf,
    /// Radii of the Gaussian, in texels, in place of the graph's own kernel.
    #[arg(long, num_args = 1.., default_values = ["1", "4", "12"], value_parser = clap::value_parser!(u32).range(1..=64))]
    pub radius: Vec<u32>,
    /// Techniques in place of the graph's own, each in all of its storages: names with usual settings (vsm, evsm4, pcf,
    /// ...), or objects as in graph files.
    #[arg(long, num_args = 1.., conflicts_with = "all")]
    pub technique: Vec<TechniqueChoice>,
    /// All techniques in all of their storages, and as references the binary test and percentage-closer filtering with the
    /// same kernel.
    #[arg(long)]
    pub all: bool,
    /// Only every Nth texel of the map along either axis counts: 2 takes a quarter of the time.
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub stride: u32,
    /// A folder for a plot of error against bits per texel, as SVG and PNG; it is made if need be.
    #[arg(long)]
    pub out: Option<PathBuf>,
    /// Prints JSON.
    #[arg(long)]
    pub json: bool,
}

/// One scene, radius, technique and storage.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ErrorRow {
    /// The scene's name.
    pub scene: String,
    /// Radius of the Gaussian, in texels.
    pub radius: u32,
    /// The figures.
    pub errors: GraphErrors,
}

/// All rows.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ErrorTable {
    /// How they were measured.
    pub setting: Setting,
    /// Only every `stride`th texel of the map along either axis counts.
    pub stride: u32,
    /// Scene by scene, radius by radius, in the order of the candidates.
    pub rows: Vec<ErrorRow>,
    /// Files that were written.
    pub plots: Vec<PathBuf>,
}

impl Options {
    /// Prints the table, and plots it where a folder is given.
    pub fn run(self) -> CommandResult {
        if let Some(out) = &self.out {
            // Before the work, which takes minutes.
            create_folder(out)?;
        }
        let mut table = self.measure(&self.candidates()?)?;
        if let Some(out) = &self.out {
            table.plot(out)?;
        }
        print(&table, self.json)
    }

    /// What is measured: all techniques, those that are named, or the graph's own in all of its storages.
    fn candidates(&self) -> Result<Vec<Candidate>, ValueError> {
        let storage = self.frame.storage;
        if !self.all && self.technique.is_empty() {
            let own = storage.map_or(Storage::OF_FOUR_MOMENTS.to_vec(), |storage| vec![storage]);
            return Ok(own.into_iter().map(Candidate::Storage).collect());
        }
        candidates(&self.technique, storage)
    }

    /// Measures every scene with every radius and every candidate. A scene is peeled once, with room for the widest kernel.
    pub fn measure(&self, candidates: &[Candidate]) -> Result<ErrorTable, LabError> {
        let render = &self.frame;
        let file = GraphFile::read(&self.graph, None)?;
        let drawn = render.drawn(&file)?;
        let profile = profile_for(None, drawn.samples);
        let profile = candidates.iter().fold(profile, |profile, candidate| {
            candidate.profile_with(profile)
        });
        let gpu = Gpu::open(profile)?;
        let files: Vec<GraphFile> = self
            .radius
            .iter()
            .map(|&radius| file.with_radius(radius))
            .collect::<Result<_, _>>()?;
        let rows_of_scene = (files.len() * candidates.len()) as u64;
        let steps = ErrorSubject::steps(&drawn) + rows_of_scene;
        let bar = progress::bar(self.scene.len() as u64 * steps, "measuring surfaces");
        let mut rows = Vec::new();
        for name in &self.scene {
            let scene = render.load(name)?;
            let options = (render, &drawn);
            let subjects =
                ErrorSubject::of_kernels(&gpu, &scene, options, &files, self.stride, || {
                    bar.inc(1)
                })?;
            for ((subject, file), &radius) in subjects.iter().zip(&files).zip(&self.radius) {
                for candidate in candidates {
                    if !file.makes(candidate.storage()) {
                        bar.inc(1);
                        continue;
                    }
                    let errors = subject.judge(&gpu, &candidate.graph(file)?, None)?;
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
            setting: Setting::of(&gpu, &self.graph, render, &drawn),
            stride: self.stride,
            rows,
            plots: Vec::new(),
        })
    }
}

impl ErrorTable {
    /// Plots the errors against the bits of a texel into a folder.
    pub fn plot(&mut self, folder: &Path) -> Result<(), LabError> {
        let chart = error_chart(&self.rows, &self.setting);
        self.plots.extend(chart.save(folder, "error-table")?);
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
        let cells = |row: &ErrorRow| {
            let errors = &row.errors;
            let shading = &errors.surfaces.shading;
            let of_surfaces = |error: f64| percent(error, "no surface");
            let facing = errors.surfaces.shading_facing.mean_absolute;
            vec![
                ("scene", row.scene.clone()),
                ("radius", row.radius.to_string()),
                ("technique", described(&errors.technique)),
                ("storage", storage_name(errors.storage).to_owned()),
                ("bits", errors.bits_per_texel.to_string()),
                ("surfaces", shading.samples.to_string()),
                ("peels", errors.surfaces.peels.to_string()),
                ("error", of_surfaces(shading.mean_absolute)),
                ("leaking", of_surfaces(shading.leaking)),
                ("too dark", of_surfaces(shading.overdarkening)),
                ("95 %", of_surfaces(shading.percentile_95)),
                ("maximum", of_surfaces(shading.maximum)),
                ("facing", of_surfaces(facing)),
                (
                    "distribution",
                    of_surfaces(errors.surfaces.distribution.mean_absolute),
                ),
                (
                    "picture",
                    percent(errors.picture.facing.mean_absolute, NO_PIXEL),
                ),
            ]
        };
        columns(f, &self.rows.iter().map(cells).collect::<Vec<_>>())?;
        for plot in &self.plots {
            writeln!(f, "{}", plot.display())?;
        }
        Ok(())
    }
}
