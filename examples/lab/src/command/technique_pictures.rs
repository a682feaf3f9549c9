//! `moment-shadows-lab technique-pictures`: every technique on one view, and where it fails.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use moment_shadows::{MapEncoding, Profile, Storage, nearest};

use super::CommandResult;
use super::drawn::Drawn;
use super::render::RenderOptions;
use crate::candidate::TechniqueChoice;
use crate::cost::table::{Cell, Columns};
use crate::error::LabError;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;
use crate::host::read_gbuffer;
use crate::judgement::{PictureTruth, Unfiltered};
use crate::metric::{NO_PIXEL, compare, percent};
use crate::picture::{create_folder, save_panels, signed_difference};
use crate::progress;
use crate::scene::{self, Scene, contacts, place_on_ground, stacked_boards};
use crate::truth::area_light::{AreaLight, USUAL_PLACES};

/// What `technique-pictures` takes.
#[derive(clap::Args)]
pub struct Options {
    /// The folder to make.
    #[arg(long)]
    out: PathBuf,
    /// A glTF or GLB file, or a procedural scene: fence-and-foliage, hall.
    #[arg(long, default_value = "hall")]
    scene: String,
    /// Only the technique of this name.
    #[arg(long)]
    only: Option<String>,
}

impl Options {
    /// Makes the pictures and prints what they show.
    pub fn run(self) -> CommandResult {
        let rows = draw(&self.out, &self.scene, self.only.as_deref())?;
        print!("{}", Columns(&rows));
        Ok(ExitCode::SUCCESS)
    }
}

/// The chain of resolve, blur (radius 4) and shading that techniques are put into.
const GRAPH: &str = include_str!("../../../hard_shadows.json");

/// Width and height of a panel; a picture has two by two.
const PANEL: [u32; 2] = [318, 178];

/// Texels per side of the light's map of the common view.
const MAP: u32 = 1024;

/// A difference of shadow intensity that is shown in full colour.
const FULL_DIFFERENCE: f32 = 0.5;

/// A technique's name, and where it fails: a scene, the texels per side of the light's map, and the technique and storage there,
/// as a command line has them.
type Subject = (
    &'static str,
    fn() -> Scene,
    u32,
    &'static str,
    Option<Storage>,
);

/// Bounds leak where occluders are stacked; elsewhere contacts fail, in a map that is fine enough.
const SUBJECTS: [Subject; 12] = [
    ("binary", contacts, 160, "binary", None),
    (
        "pcf_gaussian",
        contacts,
        160,
        r#"{"pcf": {"box": {"radius": 1}}}"#,
        None,
    ),
    (
        "pcss",
        stacked_boards,
        512,
        r#"{"pcss": {"search_taps": 6, "filter_taps": 8}}"#,
        None,
    ),
    ("esm", contacts, 512, r#"{"esm": {"exponent": 30.0}}"#, None),
    ("vsm", stacked_boards, 512, "vsm", None),
    ("evsm2", stacked_boards, 512, "evsm2", None),
    (
        "evsm4",
        stacked_boards,
        512,
        "evsm4",
        Some(Storage::Float16),
    ),
    ("lvsm", stacked_boards, 512, "lvsm", None),
    ("lvsm_lloyd", stacked_boards, 512, "lvsm_lloyd", None),
    ("convolution", contacts, 512, "convolution", None),
    ("hamburger4", stacked_boards, 512, "hamburger4", None),
    ("hausdorff4", stacked_boards, 512, "hausdorff4", None),
];

/// A scene that is drawn for maps with several samples per texel and with one.
struct Stage {
    scene: Scene,
    frames: [Frame; 2],
    truth: PictureTruth,
    /// The truth for a light of some size.
    soft: Option<Vec<f32>>,
}

/// Makes the pictures of all techniques in `out`, with `view` as the common scene; of one, if it is named. Gives what a
/// table says of each.
fn draw(out: &Path, view: &str, only: Option<&str>) -> Result<Vec<Vec<Cell<'static>>>, LabError> {
    let names = SUBJECTS.map(|(name, ..)| name);
    if let Some(only) = only.filter(|only| !names.contains(only)) {
        let nearest = nearest(only, names);
        let reason = format!("no technique of this name is pictured; the nearest are {nearest}");
        return Err(LabError::unsuitable(only, reason));
    }
    create_folder(out)?;
    let gpu = Gpu::open(Profile::NativeAdapter)?;
    let graph = GraphFile::parse("hard_shadows.json", GRAPH.to_owned(), None)?;
    let mut subjects = SUBJECTS.to_vec();
    subjects.retain(|(name, ..)| only.is_none_or(|only| only == *name));
    let bar = progress::bar(subjects.len() as u64, "drawing");
    let mut common = Stage::new(&gpu, scene::load(view)?, MAP, &graph)?;
    let mut rows = Vec::new();
    for (name, scene, map, technique, storage) in subjects {
        let mut stage = Stage::new(&gpu, place_on_ground(scene()), map, &graph)?;
        let on_view = common.shade(&gpu, &graph, name, None)?;
        let failing = stage.shade(&gpu, &graph, technique, storage)?;
        let panels = [
            on_view.picture,
            on_view.difference,
            failing.picture,
            failing.difference,
        ];
        save_panels(&out.join(format!("{name}.png")), &panels, PANEL, 2)?;
        let map = on_view.map.as_ref();
        rows.push(vec![
            ("technique", name.to_owned()),
            (
                "bits per texel",
                map.map_or("-".to_owned(), |map| map.bits_per_texel().to_string()),
            ),
            ("planes", map.map_or(0, MapEncoding::planes).to_string()),
            ("on view, percent", percent(on_view.error, NO_PIXEL)),
            ("failing, percent", percent(failing.error, NO_PIXEL)),
        ]);
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(rows)
}

/// A picture of a technique, its difference from the truth, and figures.
struct Shaded {
    picture: Vec<u8>,
    difference: Vec<u8>,
    /// Mean absolute error over the lit side of surfaces.
    error: f64,
    /// The map; none where the plain depth map is read.
    map: Option<MapEncoding>,
}

impl Stage {
    fn new(gpu: &Gpu, scene: Scene, map: u32, graph: &GraphFile) -> Result<Self, LabError> {
        let drawn = Drawn {
            picture: PANEL,
            map: [map; 2],
            ..Drawn::default()
        };
        let frames = RenderOptions::default().frames(gpu, &scene, &drawn, graph.radius()?)?;
        let truth = Unfiltered::of(gpu, &frames[0], graph)?.picture(gpu, &frames[0])?;
        Ok(Self {
            scene,
            frames,
            truth,
            soft: None,
        })
    }

    fn shade(
        &mut self,
        gpu: &Gpu,
        graph: &GraphFile,
        technique: &str,
        storage: Option<Storage>,
    ) -> Result<Shaded, LabError> {
        let choice: TechniqueChoice = technique
            .parse()
            .map_err(|error: String| LabError::unsuitable(technique, error))?;
        let file = choice.graph(graph, storage)?.in_single_precision()?;
        let soft = matches!(
            file.technique(),
            Some(moment_shadows::Technique::Pcss { .. })
        );
        if soft && self.soft.is_none() {
            self.soft = Some(self.area_light(gpu)?);
        }
        let frame = &self.frames[usize::from(file.reads_depth())];
        let graph_frame = GraphFrame::new(gpu, frame, &file)?;
        graph_frame.run(gpu)?;
        let mut found = graph_frame.read_shadow(gpu, &file)?;
        let truth = match &self.soft {
            Some(area) if soft => area,
            _ => &self.truth.shadow,
        };
        let error = compare(&found, truth, &self.truth.facing)?;
        let picture = frame.picture(gpu, graph_frame.shadow(&file)?)?;
        // What turns away from the light is dark whatever its shadow.
        for ((found, truth), facing) in found.iter_mut().zip(truth).zip(&self.truth.facing) {
            if !facing {
                *found = *truth;
            }
        }
        Ok(Shaded {
            picture,
            difference: signed_difference(&found, truth, FULL_DIFFERENCE),
            error: error.facing.mean_absolute,
            map: file.encoding().filter(|_| !file.reads_depth()),
        })
    }

    /// Shadow intensity under a light of the usual size.
    fn area_light(&self, gpu: &Gpu) -> Result<Vec<f32>, LabError> {
        let frame = &self.frames[1];
        let desc = &frame.desc;
        let light = AreaLight::new(&self.scene, &desc.light, desc.shape, USUAL_PLACES)?;
        light.picture(&read_gbuffer(gpu, &frame.surface)?)
    }
}
