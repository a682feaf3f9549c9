//! `moment-shadows minification`: a scene from afar, with and without the mip levels of a graph.

use std::fmt;
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::render::{RenderOptions, profile_for};
use super::{CommandResult, print};
use crate::error::LabError;
use crate::footprint::{Flicker, PixelTruth, lit_pixels};
use crate::frame::{Frame, FrameDesc};
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;
use crate::metric::{ErrorFigures, compare};
use crate::progress;
use crate::scene::{self, Scene};
use crate::view::View;

/// What `minification` takes.
#[derive(clap::Args)]
pub struct Options {
    #[command(flatten)]
    frame: RenderOptions,
    /// A glTF or GLB file, or a procedural scene: fence-and-foliage, hall.
    #[arg(long, default_value = "fence-and-foliage")]
    scene: String,
    /// The graph file, with a downsample node.
    #[arg(long)]
    graph: PathBuf,
    /// The camera's distance, as a multiple of the viewpoint's.
    #[arg(long, default_value_t = 8.0, value_parser = distance)]
    distance: f64,
    /// Prints JSON.
    #[arg(long)]
    json: bool,
}

/// Frames of the film.
pub const FRAMES: u32 = 60;

/// The part of the distance by which the camera comes nearer in the film.
const DOLLY: f64 = 0.1;

/// Pixels that cover at least so many texels along their longer axis are far away.
const FAR: f64 = 8.0;

/// What a graph gives.
#[derive(Clone, Debug, Serialize)]
pub struct Figures {
    /// Error over pixels that cover at least 8 texels.
    pub far: ErrorFigures,
    /// Error over all pixels that show one lit surface.
    pub all: ErrorFigures,
    /// Mean absolute second difference of shadow intensity over the film.
    pub flicker: f64,
}

/// The outcome.
#[derive(Clone, Debug, Serialize)]
pub struct Minification {
    /// The scene's name.
    pub scene: String,
    /// Texels that half of the judged pixels cover at least, along their longer axis.
    pub median_texels: f64,
    /// The graph as it is.
    pub with_mips: Figures,
    /// The graph without mip levels.
    pub without_mips: Figures,
}

impl Options {
    /// Prints the outcome.
    pub fn run(self) -> CommandResult {
        let options = RenderOptions {
            scene: self.scene,
            ..self.frame
        };
        print(&measure(&options, &self.graph, self.distance)?, self.json)
    }
}

/// A multiple of a distance.
fn distance(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(distance) if (1.0..=1000.0).contains(&distance) => Ok(distance),
        _ => Err("a distance is a number from 1 to 1000".to_owned()),
    }
}

/// Measures a graph with mip levels from `distance` times the viewpoint's own distance.
fn measure(options: &RenderOptions, graph: &Path, distance: f64) -> Result<Minification, LabError> {
    let with = GraphFile::read(graph, options.storage)?.in_single_precision()?;
    let without = with.without_mip_levels()?;
    let scene = scene::load(&options.scene)?;
    let gpu = Gpu::open(profile_for(options.storage, options.samples))?;
    let margin = with.kernel()?.map_or(0, |kernel| kernel.radius());
    let near = options.frame(&gpu, &scene, margin)?.desc;
    let at = |distance: f64| from_afar(&scene, options, near, distance);
    let bar = progress::bar(u64::from(FRAMES) + 2, "truth");
    let truth = PixelTruth::of(&gpu, &scene, at(distance), &with)?;
    bar.inc(1);
    let frame = Frame::draw(&gpu, &scene, at(distance))?;
    let far: Vec<bool> = truth
        .judged
        .iter()
        .zip(&truth.texels)
        .map(|(&judged, &texels)| judged && texels >= FAR)
        .collect();
    let mut figures = Vec::new();
    for file in [&with, &without] {
        let shadow = shadow(&gpu, &frame, file)?;
        figures.push(Figures {
            far: compare(&shadow, &truth.truth, &far)?.facing,
            all: compare(&shadow, &truth.truth, &truth.judged)?.facing,
            flicker: 0.0,
        });
    }
    bar.inc(1);
    bar.set_message("film");
    let mut flicker = [Flicker::default(), Flicker::default()];
    for number in 0..FRAMES {
        let nearer = 1.0 - DOLLY * f64::from(number) / f64::from(FRAMES - 1);
        let frame = Frame::draw(&gpu, &scene, at(distance * nearer))?;
        let judged = lit_pixels(&gpu, &frame)?;
        for (flicker, file) in flicker.iter_mut().zip([&with, &without]) {
            flicker.add(shadow(&gpu, &frame, file)?, judged.clone());
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    for (figures, flicker) in figures.iter_mut().zip(&flicker) {
        figures.flicker = flicker.mean();
    }
    let [with_mips, without_mips] = [figures.remove(0), figures.remove(0)];
    Ok(Minification {
        scene: scene.name.clone(),
        median_texels: median(&truth),
        with_mips,
        without_mips,
    })
}

/// The frame with its camera moved back along its view.
fn from_afar(scene: &Scene, options: &RenderOptions, near: FrameDesc, distance: f64) -> FrameDesc {
    let view = View::numbered(scene, options.view).camera;
    let mut camera = near.camera;
    camera.eye = view.target + distance * (view.eye - view.target);
    camera.near = view.near * distance;
    FrameDesc { camera, ..near }
}

fn shadow(gpu: &Gpu, frame: &Frame, file: &GraphFile) -> Result<Vec<f32>, LabError> {
    let graph_frame = GraphFrame::new(gpu, frame, file)?;
    graph_frame.run(gpu)?;
    graph_frame.read_shadow(gpu, file)
}

fn median(truth: &PixelTruth) -> f64 {
    let mut texels: Vec<f64> = truth
        .texels
        .iter()
        .zip(&truth.judged)
        .filter_map(|(&texels, &judged)| judged.then_some(texels))
        .collect();
    texels.sort_unstable_by(f64::total_cmp);
    texels.get(texels.len() / 2).copied().unwrap_or(0.0)
}

impl fmt::Display for Minification {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{}: {} judged pixels, half of them over {:.1} texels; {} over 8 and more",
            self.scene, self.with_mips.all.samples, self.median_texels, self.with_mips.far.samples
        )?;
        writeln!(
            f,
            "{:<14} {:>9} {:>9} {:>9} {:>9} {:>9}",
            "", "error far", "leaking", "too dark", "error all", "flicker"
        )?;
        for (name, figures) in [
            ("with mips", &self.with_mips),
            ("without mips", &self.without_mips),
        ] {
            writeln!(
                f,
                "{name:<14} {:>9.5} {:>9.5} {:>9.5} {:>9.5} {:>9.5}",
                figures.far.mean_absolute,
                figures.far.leaking,
                figures.far.overdarkening,
                figures.all.mean_absolute,
                figures.flicker
            )?;
        }
        let ratio = |with: f64, without: f64| with / without.max(f64::MIN_POSITIVE);
        writeln!(
            f,
            "{:<14} {:>9.3} {:>29.3} {:>9.3}",
            "ratio",
            ratio(
                self.with_mips.far.mean_absolute,
                self.without_mips.far.mean_absolute
            ),
            ratio(
                self.with_mips.all.mean_absolute,
                self.without_mips.all.mean_absolute
            ),
            ratio(self.with_mips.flicker, self.without_mips.flicker)
        )
    }
}
