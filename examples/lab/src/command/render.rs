//! `moment-shadows-lab render`: a scene with the shadows of a graph, as a picture.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::builder::TypedValueParser;
use glam::DVec3;
use moment_shadows::{Profile, Storage};
use moment_shadows_graph::TextureDesc;

use super::drawn::Drawn;
use super::{CommandResult, argument};
use crate::candidate::TechniqueChoice;
use crate::error::LabError;
use crate::frame::{Frame, FrameDesc};
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;
use crate::judgement::{Judgement, Truth};
use crate::light::LightShape;
use crate::metric::{NO_PIXEL, percent};
use crate::picture::{check_picture, grey, save_grey, save_rgba, signed_difference};
use crate::progress;
use crate::scene::{self, Scene};
use crate::view::View;

/// The light of a rendering.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum LightChoice {
    /// A sun, fitted to the casters.
    Sun,
    /// A spot light from the same side.
    Spot,
}

/// What `render` takes.
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
    /// The picture to write, as PNG or JPEG by its ending.
    #[arg(long)]
    out: PathBuf,
    /// A technique in place of the graph's own: a name, or settings as in a graph file. Tests on the plain depth map
    /// (binary, pcf, pcss) get a map of one sample per texel.
    #[arg(long, value_name = "NAME|JSON")]
    technique: Option<TechniqueChoice>,
    /// Also writes the brute-force picture and the difference, and prints the error.
    #[arg(long)]
    truth: bool,
}

/// What to render. The scene and the technique are arguments of their own in each command.
#[derive(Clone, Debug, clap::Args)]
pub struct RenderOptions {
    /// A glTF file or the name of a procedural scene.
    #[arg(skip = scene::PROCEDURAL[0].to_owned())]
    pub scene: String,
    /// One of the numbered viewpoints and light directions.
    #[arg(long, default_value_t = 0)]
    pub view: u32,
    /// The light.
    #[arg(long, value_enum, default_value = "sun")]
    pub light: LightChoice,
    /// Along which the light shines, in place of the viewpoint's direction: in the axes of the file, of any length but zero.
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, value_parser = argument::direction)]
    pub light_direction: Option<DVec3>,
    /// Where the camera stands and what it looks at, in place of the viewpoint: in the coordinates of the file, although a
    /// scene is moved so that the middle of its lowest points is at zero.
    #[arg(long, value_name = "EX,EY,EZ,TX,TY,TZ", allow_hyphen_values = true, value_parser = argument::camera)]
    pub camera: Option<[DVec3; 2]>,
    /// Leaves out the ground plane, which otherwise touches the scene's lowest point.
    #[arg(long)]
    pub no_ground: bool,
    /// Stores the light's depth reversed.
    #[arg(long)]
    pub reversed: bool,
    /// Width of the picture; the height follows at 16 to 9. Where it is left out, the size of the graph's import
    /// 'camera_depth', or 1280.
    #[arg(long = "width", value_name = "WIDTH", value_parser = clap::value_parser!(u32).range(16..=8192).map(|width| [width, width * 9 / 16]))]
    pub size: Option<[u32; 2]>,
    /// Texels per side of the light's map. Where it is left out, the size of the graph's import 'light_depth', or 1024.
    #[arg(long, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub map: Option<u32>,
    /// Samples per texel of the light's map: 1 and 4 everywhere, 2 and 8 where the device can. Where it is left out, as many
    /// as the graph's import 'light_depth' has, or 4.
    #[arg(long)]
    pub samples: Option<u32>,
    /// How many times as long the light's range of moment depth is as its casters ask for: a sun's as much longer in front of them
    /// as behind, a spot light's behind.
    #[arg(long, default_value_t = 1.0, value_name = "TIMES", value_parser = argument::times)]
    pub range_times: f64,
    /// A storage in place of the graph's own.
    #[arg(long, value_parser = argument::storage())]
    pub storage: Option<Storage>,
    /// A technique in place of the graph's own.
    #[arg(skip)]
    pub technique: Option<TechniqueChoice>,
}

impl Default for RenderOptions {
    fn default() -> Self {
        argument::defaults(&[])
    }
}

/// The distance of a spot light's near plane, as a part of its distance to the scene.
const SPOT_NEAR: f64 = 0.05;

impl RenderOptions {
    /// The graph file, with these options' technique and storage, or with `storage` in place of that.
    pub fn graph(&self, path: &Path, storage: Option<Storage>) -> Result<GraphFile, LabError> {
        let storage = storage.or(self.storage);
        match &self.technique {
            None => GraphFile::read(path, storage),
            Some(technique) => technique.graph(&GraphFile::read(path, None)?, storage),
        }
    }

    /// Loads a scene, and says which ground it is given.
    pub fn load(&self, name: &str) -> Result<Scene, LabError> {
        let scene = scene::load(name)?;
        if self.no_ground {
            return Ok(scene.without_ground());
        }
        if let Some(height) = scene.ground {
            let height = scene.origin.y + height;
            eprintln!("{name}: a ground plane at y = {height} is added; --no-ground leaves it out");
        }
        Ok(scene)
    }

    /// Draws the scene as [`frame`](Self::frame) does, and with one sample per texel.
    pub fn frames(
        &self,
        gpu: &Gpu,
        scene: &Scene,
        drawn: &Drawn,
        margin: u32,
    ) -> Result<[Frame; 2], LabError> {
        let plain = Drawn {
            samples: 1,
            ..*drawn
        };
        Ok([
            self.frame(gpu, scene, drawn, margin)?,
            self.frame(gpu, scene, &plain, margin)?,
        ])
    }

    /// Draws the scene as the options say, for a graph whose kernel has a radius of `margin` texels.
    pub fn frame(
        &self,
        gpu: &Gpu,
        scene: &Scene,
        drawn: &Drawn,
        margin: u32,
    ) -> Result<Frame, LabError> {
        let mut view = View::numbered(scene, self.view);
        view.light_direction = self.light_direction.unwrap_or(view.light_direction);
        if let Some(camera) = self.camera {
            view = view.seen_from(scene, camera)?;
        }
        let (map, [width, height]) = (drawn.map, drawn.picture);
        // The kernel and the bilinear lookup find the far end beyond the outermost caster.
        let light = match self.light {
            LightChoice::Sun => view.sun(scene, map, f64::from(margin) + 2.0, self.reversed)?,
            LightChoice::Spot => view.spot(scene, SPOT_NEAR, None, self.reversed)?,
        };
        let light = light.with_range_times(self.range_times);
        let mut camera = view.camera;
        camera.aspect = f64::from(width) / f64::from(height.max(1));
        let wgpu_format = |format| TextureDesc::new(format, map).wgpu_format();
        Frame::draw(
            gpu,
            scene,
            FrameDesc {
                picture: drawn.picture,
                map,
                samples: drawn.samples,
                format: wgpu_format(drawn.format),
                camera_depth: (wgpu_format(drawn.camera_format), drawn.camera_samples),
                shape: LightShape::usual(&light),
                light,
                camera,
            },
        )
    }
}

/// The smallest profile under which a device can do what is asked.
pub fn profile_for(storage: Option<Storage>, samples: u32) -> Profile {
    match (storage, samples) {
        (_, 2 | 8) => Profile::NativeAdapter,
        (Some(storage), _) if storage.check(Profile::WebgpuCore).is_ok() => Profile::WebgpuCore,
        _ => Profile::Native,
    }
}

impl Options {
    /// Renders, and prints the error where the truth is asked for.
    pub fn run(self) -> CommandResult {
        let options = RenderOptions {
            scene: self.scene,
            technique: self.technique,
            ..self.frame
        };
        if let Some((judgement, truth)) = render(&options, &self.graph, &self.out, self.truth)? {
            println!("{}", judgement.error);
            println!("exact bound on the same depths\n{}", truth.bound_error);
            println!("{}", judgement.excess);
            let error = judgement.error.facing.mean_absolute;
            println!(
                "mean absolute error in percent: {}",
                percent(error, NO_PIXEL)
            );
        }
        Ok(ExitCode::SUCCESS)
    }
}

/// Renders to `out`. With `truth`, also writes the brute-force picture and the difference beside it, and gives the
/// judgement.
fn render(
    options: &RenderOptions,
    graph: &Path,
    out: &Path,
    truth: bool,
) -> Result<Option<(Judgement, Truth)>, LabError> {
    check_picture(out)?;
    let file = options.graph(graph, None)?;
    let drawn = options.drawn(&file)?;
    eprintln!("{drawn}");
    let bar = progress::bar(if truth { 5 } else { 4 }, "loading");
    let scene = options.load(&options.scene)?;
    bar.inc(1);
    bar.set_message("drawing");
    let gpu = Gpu::open(file.profile(drawn.samples.max(drawn.camera_samples)))?;
    let frame = options.frame(&gpu, &scene, &drawn, file.radius()?)?;
    bar.inc(1);
    bar.set_message("shadows");
    let graph_frame = GraphFrame::new(&gpu, &frame, &file)?;
    graph_frame.run(&gpu)?;
    let picture = frame.picture(&gpu, graph_frame.shadow(&file)?)?;
    bar.inc(1);
    let [width, height] = drawn.picture;
    let judged = if truth {
        bar.set_message("brute force");
        let shadow = graph_frame.read_shadow(&gpu, &file)?;
        let truth = Truth::of(&gpu, &frame, &file)?;
        let judgement = truth.judge(&shadow)?;
        let visibility: Vec<f32> = truth
            .truth
            .iter()
            .map(|intensity| 1.0 - intensity)
            .collect();
        save_grey(&beside(out, "truth"), width, height, &grey(&visibility))?;
        let estimate: Vec<f32> = shadow.iter().map(|intensity| 1.0 - intensity).collect();
        save_grey(&beside(out, "shadow"), width, height, &grey(&estimate))?;
        let difference = signed_difference(&shadow, &truth.truth, 0.5);
        save_rgba(&beside(out, "difference"), width, height, &difference)?;
        bar.inc(1);
        Some((judgement, truth))
    } else {
        None
    };
    save_rgba(out, width, height, &picture)?;
    bar.inc(1);
    bar.finish_and_clear();
    Ok(judged)
}

/// `picture.png` becomes `picture-truth.png`; the ending stays.
pub fn beside(out: &Path, what: &str) -> PathBuf {
    let stem = out
        .file_stem()
        .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
    let ending = out.extension().unwrap_or_default();
    out.with_file_name(format!("{stem}-{what}"))
        .with_added_extension(ending)
}
