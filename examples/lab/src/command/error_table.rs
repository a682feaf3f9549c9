//! `moment-shadows error-table`: the error over all surfaces of scenes, for storages and radii.

use core::fmt;
use std::path::Path;

use moment_shadows::Storage;
use serde::Serialize;

use super::error::{ErrorSubject, GraphErrors, Setting};
use super::render::{RenderOptions, profile_for};
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::progress;
use crate::scene;

/// One scene, radius and storage.
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
    /// Scene by scene, radius by radius, storage by storage.
    pub rows: Vec<ErrorRow>,
}

/// Measures every scene with every radius and every storage, or with the one that `options` names.
pub fn run(
    scenes: &[String],
    radii: &[u32],
    graph: &Path,
    options: &RenderOptions,
) -> Result<ErrorTable, LabError> {
    let storages = options
        .storage
        .map_or(Storage::ALL.to_vec(), |storage| vec![storage]);
    let gpu = Gpu::open(profile_for(None, options.samples))?;
    let per_radius = ErrorSubject::steps(options) + storages.len() as u64;
    let runs = (scenes.len() * radii.len()) as u64;
    let bar = progress::bar(runs * per_radius, "measuring surfaces");
    let mut rows = Vec::new();
    for name in scenes {
        let scene = scene::load(name)?;
        for &radius in radii {
            let file = |storage| GraphFile::read(graph, storage)?.with_radius(radius);
            let subject = ErrorSubject::new(&gpu, &scene, options, &file(None)?, || bar.inc(1))?;
            for &storage in &storages {
                rows.push(ErrorRow {
                    scene: scene.name.clone(),
                    radius,
                    errors: subject.judge(&gpu, &file(Some(storage))?, None)?,
                });
                bar.inc(1);
            }
        }
    }
    bar.finish_and_clear();
    Ok(ErrorTable {
        setting: Setting::of(&gpu, graph, options),
        rows,
    })
}

impl fmt::Display for ErrorTable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.setting)?;
        writeln!(
            f,
            "Mean absolute error of shadow intensity in percent, over all surfaces on rays that meet a caster (facing: over those \
             that face the light; distribution: of the moments alone; picture: over facing pixels).\n"
        )?;
        writeln!(
            f,
            "| scene | radius | storage | surfaces | peels | error | leaking | too dark | 95 % | maximum | facing | distribution | picture |"
        )?;
        writeln!(f, "|---|---|---|---|---|---|---|---|---|---|---|---|---|")?;
        for ErrorRow {
            scene,
            radius,
            errors,
        } in &self.rows
        {
            let shading = &errors.surfaces.shading;
            write!(
                f,
                "| {scene} | {radius} | {} | {} | {} |",
                errors.storage, shading.samples, errors.surfaces.peels
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
        Ok(())
    }
}
