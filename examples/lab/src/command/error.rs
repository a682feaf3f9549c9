//! `moment-shadows-lab error`: the error of a graph over all surfaces that the light's rays meet.

use core::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use moment_shadows::{FourMomentsBias, Storage, Technique};
use serde::Serialize;

use super::drawn::Drawn;
use super::render::{LightChoice, RenderOptions, profile_for};
use super::{CommandResult, print};
use crate::candidate::TechniqueChoice;
use crate::error::LabError;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::judgement::{PictureTruth, Unfiltered};
use crate::metric::{Comparison, ErrorFigures, NO_PIXEL, compare};
use crate::progress;
use crate::scene::Scene;
use crate::surface_error::{MapRun, SurfaceErrors, SurfaceTruth};
use crate::techniques::described;
use crate::truth::kernel::TapPattern;

/// What `error` takes.
#[derive(clap::Args)]
pub struct Options {
    #[command(flatten)]
    frame: RenderOptions,
    /// A glTF or GLB file, or a procedural scene: fence-and-foliage, hall.
    #[arg(long, default_value = "fence-and-foliage")]
    scene: String,
    /// The graph file.
    #[arg(long)]
    graph: PathBuf,
    /// A Gaussian of this radius, in texels, in place of the graph's own kernel.
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=64))]
    radius: Option<u32>,
    /// A technique in place of the graph's own: a name with usual settings (vsm, evsm4, pcf, ...), or an object as in
    /// graph files ({"esm":{"exponent":80}}).
    #[arg(long)]
    technique: Option<TechniqueChoice>,
    /// Prints JSON.
    #[arg(long)]
    json: bool,
}

impl Options {
    /// Prints the report.
    pub fn run(self) -> CommandResult {
        let options = RenderOptions {
            scene: self.scene,
            ..self.frame
        };
        let report = measure(&options, &self.graph, self.radius, self.technique.as_ref())?;
        print(&report, self.json)
    }
}

/// A drawn scene with the truths for one kernel: of all its surfaces, and of a picture.
pub struct ErrorSubject {
    /// The scene as drawn, and with one sample per texel of the light's depth, for techniques that read the plain depth map.
    frames: Arc<[Frame; 2]>,
    /// All surfaces.
    pub surfaces: SurfaceTruth,
    /// What the camera sees.
    pub picture: PictureTruth,
}

/// What a graph gives of a subject.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GraphErrors {
    /// What the map was shaded with.
    pub technique: Technique,
    /// The storage of the filtered map; none where the plain depth map is read.
    pub storage: Option<Storage>,
    /// Bits per texel of the map, all planes.
    pub bits_per_texel: u32,
    /// Errors over all surfaces.
    pub surfaces: SurfaceErrors,
    /// Errors over the pixels of the picture.
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
    /// Along which the light shines, in place of the view's direction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub light_direction: Option<[f64; 3]>,
    /// Where the camera stands and what it looks at, in place of the view's, in the file's coordinates.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub camera: Option<[[f64; 3]; 2]>,
    /// How many times as long the light's range is as its casters ask for.
    pub range_times: f64,
    /// Whether the scene was given a ground plane.
    pub ground: bool,
    /// What is drawn.
    #[serde(flatten)]
    pub drawn: Drawn,
}

/// The kernel of a graph.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct KernelFigures {
    /// Texels on either side of the centre.
    pub radius: u32,
    /// Standard deviation in texels.
    pub standard_deviation: f32,
}

/// What `moment-shadows-lab error` prints.
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
        (options, drawn): (&RenderOptions, &Drawn),
        file: &GraphFile,
        step: impl Fn(),
    ) -> Result<Self, LabError> {
        let files = core::slice::from_ref(file);
        let mut subjects = Self::of_kernels(gpu, scene, (options, drawn), files, 1, step)?;
        subjects
            .pop()
            .ok_or_else(|| LabError::unsuitable(&file.name, "there is nothing to measure"))
    }

    /// Draws and peels a scene once, with room for the widest of the kernels around it, and computes its truths for the
    /// kernel of each graph. Of the map's texels every `stride`-th along either axis counts.
    pub fn of_kernels(
        gpu: &Gpu,
        scene: &Scene,
        (options, drawn): (&RenderOptions, &Drawn),
        files: &[GraphFile],
        stride: u32,
        step: impl Fn(),
    ) -> Result<Vec<Self>, LabError> {
        let mut margin = 0;
        for file in files {
            margin = margin.max(file.radius()?);
        }
        let frames = Arc::new(options.frames(gpu, scene, drawn, margin)?);
        let frame = &frames[0];
        let Some(first) = files.first() else {
            return Ok(Vec::new());
        };
        let mut unfiltered = Unfiltered::of(gpu, frame, first)?;
        let mut kernels = Vec::new();
        let mut pictures = Vec::new();
        for file in files {
            let kernel = file.kernel()?;
            let taps = kernel.map_or_else(TapPattern::unblurred, |k| TapPattern::of_kernel(&k));
            kernels.push(taps.clone());
            unfiltered.taps = taps;
            pictures.push(unfiltered.picture(gpu, frame)?);
        }
        step();
        let depths = &unfiltered.depths;
        let truths = SurfaceTruth::of(scene, frame, depths, &kernels, stride, step)?;
        let subjects = truths.into_iter().zip(pictures);
        Ok(subjects
            .map(|(surfaces, picture)| Self {
                frames: Arc::clone(&frames),
                surfaces,
                picture,
            })
            .collect())
    }

    /// The scene as drawn.
    #[must_use]
    pub fn frame(&self) -> &Frame {
        &self.frames[0]
    }

    /// How many steps [`new`](Self::new) and [`of_kernels`](Self::of_kernels) take.
    pub fn steps(drawn: &Drawn) -> u64 {
        1 + SurfaceTruth::steps(drawn.map)
    }

    /// Runs a graph with the subject's kernel and judges what it gives. Four moments are evaluated with `moment_bias`, or
    /// with that of their storage; the picture always with the latter.
    pub fn judge(
        &self,
        gpu: &Gpu,
        file: &GraphFile,
        moment_bias: Option<FourMomentsBias>,
    ) -> Result<GraphErrors, LabError> {
        let frame = &self.frames[usize::from(file.reads_depth())];
        let run = MapRun::new(gpu, frame, file)?;
        let map = run.map(frame)?;
        let shadow = run.graph.read_shadow(gpu, &run.file)?;
        Ok(GraphErrors {
            technique: map.technique(),
            storage: map.storage(),
            bits_per_texel: map.bits_per_texel(),
            surfaces: self.surfaces.judge(gpu, &map, run.shading, moment_bias)?,
            picture: compare(&shadow, &self.picture.shadow, &self.picture.facing)?,
        })
    }
}

impl Setting {
    /// The setting of a run with these options, for what is drawn.
    pub fn of(gpu: &Gpu, graph: &Path, options: &RenderOptions, drawn: &Drawn) -> Self {
        Self {
            adapter: gpu.adapter.get_info().name,
            graph: graph.display().to_string(),
            light: match options.light {
                LightChoice::Sun => "sun",
                LightChoice::Spot => "spot",
            },
            view: options.view,
            light_direction: options.light_direction.map(|along| along.to_array()),
            camera: options
                .camera
                .map(|camera| camera.map(|point| point.to_array())),
            range_times: options.range_times,
            ground: !options.no_ground,
            drawn: *drawn,
        }
    }
}

/// Measures the graph on one scene; `radius` replaces the kernel by a Gaussian, and `technique` the technique and the
/// storage of the map.
pub fn measure(
    options: &RenderOptions,
    graph: &Path,
    radius: Option<u32>,
    technique: Option<&TechniqueChoice>,
) -> Result<ErrorReport, LabError> {
    let candidate = technique.map(|choice| choice.in_storage(options.storage));
    let candidate = candidate.transpose()?;
    let storage = options.storage.filter(|_| candidate.is_none());
    let mut file = GraphFile::read(graph, storage)?;
    if let Some(radius) = radius {
        file = file.with_radius(radius)?;
    }
    let drawn = options.drawn(&file)?;
    let mut profile = profile_for(storage, drawn.samples);
    if let Some(candidate) = &candidate {
        file = candidate.graph(&file)?;
        profile = candidate.profile_with(profile);
    }
    let scene = options.load(&options.scene)?;
    let gpu = Gpu::open(profile)?;
    let bar = progress::bar(ErrorSubject::steps(&drawn) + 1, "measuring surfaces");
    let subject = ErrorSubject::new(&gpu, &scene, (options, &drawn), &file, || bar.inc(1))?;
    let errors = subject.judge(&gpu, &file, None)?;
    bar.finish_and_clear();
    Ok(ErrorReport {
        scene: scene.name,
        setting: Setting::of(&gpu, graph, options, &drawn),
        kernel: file.kernel()?.map(|kernel| KernelFigures {
            radius: kernel.radius(),
            standard_deviation: kernel.standard_deviation(),
        }),
        errors,
    })
}

/// A storage as tables name it.
pub(crate) fn storage_name(storage: Option<Storage>) -> &'static str {
    storage.map_or("depth", Storage::name)
}

impl fmt::Display for Setting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} on {}; {} of view {}, {}",
            self.graph, self.adapter, self.light, self.view, self.drawn
        )?;
        if let Some(along) = self.light_direction {
            write!(f, ", light along {along:?}")?;
        }
        if let Some([eye, target]) = self.camera {
            write!(f, ", camera at {eye:?} towards {target:?}")?;
        }
        if self.range_times > 1.0 {
            write!(f, ", {} times the range", self.range_times)?;
        }
        f.write_str(if self.ground { "" } else { ", no ground" })
    }
}

impl fmt::Display for ErrorReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let GraphErrors {
            technique,
            storage,
            bits_per_texel,
            surfaces,
            picture,
        } = &self.errors;
        write!(
            f,
            "{}, {} as {} ({bits_per_texel} bits per texel), ",
            self.scene,
            described(technique),
            storage_name(*storage)
        )?;
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
            "percent of full shadow",
            "samples",
            "mean abs",
            "leaking",
            "too dark",
            "95 %",
            "maximum"
        )?;
        let rows: [(&str, &ErrorFigures); 6] = [
            ("all surfaces, shading", &surfaces.shading),
            ("  facing the light", &surfaces.shading_facing),
            ("  on all rays", &surfaces.shading_all_rays),
            ("all surfaces, distribution", &surfaces.distribution),
            ("picture, facing the light", &picture.facing),
            ("  in the penumbra", &picture.penumbra),
        ];
        for (index, (name, figures)) in rows.into_iter().enumerate() {
            let none = if index < 4 { "no surface" } else { NO_PIXEL };
            writeln!(f, "{name:<26}{}", figures.columns(none))?;
        }
        Ok(())
    }
}
