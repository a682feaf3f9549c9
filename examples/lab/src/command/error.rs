//! `moment-shadows error`: the error of a graph over all surfaces that the light's rays meet.

use core::fmt;
use std::path::Path;

use moment_shadows::{MomentBias, Storage};
use serde::Serialize;

use super::render::{LightChoice, RenderOptions, profile_for};
use crate::error::LabError;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::{GraphFrame, storage_of};
use crate::judgement::{PictureTruth, Unfiltered};
use crate::metric::{Comparison, ErrorFigures, compare};
use crate::progress;
use crate::scene::{self, Scene};
use crate::surface_error::{Evaluation, SurfaceErrors, SurfaceTruth};

/// A drawn scene with the truths for one kernel: of all its surfaces, and of a picture.
pub struct ErrorSubject {
    /// The scene as drawn.
    pub frame: Frame,
    /// All surfaces.
    pub surfaces: SurfaceTruth,
    /// What the camera sees.
    pub picture: PictureTruth,
}

/// What a graph gives of a subject.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GraphErrors {
    /// The storage of the filtered map.
    pub storage: Storage,
    /// Over all surfaces.
    pub surfaces: SurfaceErrors,
    /// Over the pixels of the picture.
    pub picture: Comparison,
}

/// What was measured, and how.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Setting {
    /// The adapter that drew and evaluated.
    pub adapter: String,
    /// The graph file.
    pub graph: String,
    /// Whether the light is a sun or a spot light.
    pub light: &'static str,
    /// The numbered viewpoint, which the light's direction belongs to.
    pub view: u32,
    /// Texels per side of the light's map.
    pub map: u32,
    /// Samples per texel of the light's depth.
    pub samples: u32,
    /// Width and height of the picture.
    pub picture: [u32; 2],
}

/// The kernel of a graph.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct KernelFigures {
    /// Texels on either side of the centre.
    pub radius: u32,
    /// In texels.
    pub standard_deviation: f32,
}

/// What `moment-shadows error` prints.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ErrorReport {
    /// The scene's name.
    pub scene: String,
    /// How it was measured.
    pub setting: Setting,
    /// The kernel; none for a map that is not blurred.
    pub kernel: Option<KernelFigures>,
    /// The figures.
    pub errors: GraphErrors,
}

impl ErrorSubject {
    /// Draws a scene and computes its truths for the kernel of a graph. `step` is called [`steps`](Self::steps) times.
    pub fn new(
        gpu: &Gpu,
        scene: &Scene,
        options: &RenderOptions,
        file: &GraphFile,
        step: impl Fn(),
    ) -> Result<Self, LabError> {
        let margin = file.kernel()?.map_or(0, |kernel| kernel.radius());
        let frame = options.frame(gpu, scene, margin)?;
        let unfiltered = Unfiltered::of(gpu, &frame, file)?;
        let picture = unfiltered.picture(gpu, &frame)?;
        step();
        Ok(Self {
            surfaces: SurfaceTruth::of(scene, &frame, &unfiltered, step)?,
            frame,
            picture,
        })
    }

    /// How many steps [`new`](Self::new) takes.
    pub fn steps(options: &RenderOptions) -> u64 {
        1 + SurfaceTruth::steps([options.map; 2])
    }

    /// Runs a graph with the subject's kernel and judges what it gives. The map is evaluated with `moment_bias`, or with
    /// that of its storage; the picture always with the latter.
    pub fn judge(
        &self,
        gpu: &Gpu,
        file: &GraphFile,
        moment_bias: Option<MomentBias>,
    ) -> Result<GraphErrors, LabError> {
        let (file, map) = file.in_single_precision()?.with_filtered_map()?;
        let graph = GraphFrame::new(gpu, &self.frame, &file)?;
        graph.run(gpu)?;
        let unsuitable = || LabError::Unsuitable {
            file: file.name.clone(),
            reason: "the input of its shade_hard node is no map of moments".to_owned(),
        };
        let map = graph.bindings.output(&map).ok_or_else(unsuitable)?;
        let storage = storage_of(map).ok_or_else(unsuitable)?;
        let shading = Evaluation {
            moment_bias,
            ..Evaluation::shading(&self.frame, &file)?
        };
        let shadow = graph.read_shadow(gpu, &file)?;
        Ok(GraphErrors {
            storage,
            surfaces: self.surfaces.judge(gpu, map, storage, shading)?,
            picture: compare(&shadow, &self.picture.shadow, &self.picture.facing)?,
        })
    }
}

impl Setting {
    /// That of a run with these options.
    pub fn of(gpu: &Gpu, graph: &Path, options: &RenderOptions) -> Self {
        Self {
            adapter: gpu.adapter.get_info().name,
            graph: graph.display().to_string(),
            light: match options.light {
                LightChoice::Sun => "sun",
                LightChoice::Spot => "spot",
            },
            view: options.view,
            map: options.map,
            samples: options.samples,
            picture: options.size,
        }
    }
}

/// Measures the graph on one scene; `radius` replaces the kernel by a Gaussian.
pub fn run(
    options: &RenderOptions,
    graph: &Path,
    radius: Option<u32>,
) -> Result<ErrorReport, LabError> {
    let mut file = GraphFile::read(graph, options.storage)?;
    if let Some(radius) = radius {
        file = file.with_radius(radius)?;
    }
    let scene = scene::load(&options.scene)?;
    for warning in &scene.warnings {
        eprintln!("warning: {}: {warning}", options.scene);
    }
    let gpu = Gpu::open(profile_for(options.storage, options.samples))?;
    let bar = progress::bar(ErrorSubject::steps(options) + 1, "measuring surfaces");
    let subject = ErrorSubject::new(&gpu, &scene, options, &file, || bar.inc(1))?;
    let errors = subject.judge(&gpu, &file, None)?;
    bar.finish_and_clear();
    Ok(ErrorReport {
        scene: scene.name,
        setting: Setting::of(&gpu, graph, options),
        kernel: file.kernel()?.map(|kernel| KernelFigures {
            radius: kernel.radius(),
            standard_deviation: kernel.standard_deviation(),
        }),
        errors,
    })
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [width, height] = self.picture;
        write!(
            f,
            "{} on {}; {} of view {}, map {}x{} with {} samples per texel, picture {width}x{height}",
            self.graph, self.adapter, self.light, self.view, self.map, self.map, self.samples
        )
    }
}

impl fmt::Display for ErrorReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let GraphErrors {
            storage,
            surfaces,
            picture,
        } = &self.errors;
        write!(f, "{}, {storage}, ", self.scene)?;
        match self.kernel {
            Some(kernel) => writeln!(
                f,
                "radius {} (standard deviation {:.3} texels)",
                kernel.radius, kernel.standard_deviation
            )?,
            None => writeln!(f, "no blur")?,
        }
        writeln!(f, "{}", self.setting)?;
        writeln!(
            f,
            "rays {}, of them {} meet a caster; peels {}; NaN {}",
            surfaces.rays, surfaces.caster_rays, surfaces.peels, surfaces.nan
        )?;
        writeln!(
            f,
            "{:<26} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10}",
            "mean absolute error", "samples", "mean abs", "leaking", "too dark", "95 %", "maximum"
        )?;
        let rows: [(&str, &ErrorFigures); 6] = [
            ("all surfaces, shading", &surfaces.shading),
            ("  facing the light", &surfaces.shading_facing),
            ("  on all rays", &surfaces.shading_all_rays),
            ("all surfaces, distribution", &surfaces.distribution),
            ("picture, facing the light", &picture.facing),
            ("  in the penumbra", &picture.penumbra),
        ];
        for (name, figures) in rows {
            writeln!(
                f,
                "{name:<26} {:>10} {:>10.7} {:>10.7} {:>10.7} {:>10.7} {:>10.7}",
                figures.samples,
                figures.mean_absolute,
                figures.leaking,
                figures.overdarkening,
                figures.percentile_95,
                figures.maximum
            )?;
        }
        Ok(())
    }
}
