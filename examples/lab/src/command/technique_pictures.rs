//! `moment-shadows technique-pictures`: every technique on one view, and where it fails.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use moment_shadows::{Profile, Storage, nearest};

use super::CommandResult;
use super::render::RenderOptions;
use crate::error::LabError;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;
use crate::host::read_gbuffer;
use crate::judgement::{PictureTruth, Unfiltered};
use crate::metric::compare;
use crate::picture::{PictureError, save_panels, signed_difference};
use crate::progress;
use crate::scene::{self, Scene, contacts, place_on_ground, stacked_boards};
use crate::technique_argument::TechniqueArgument;
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
        let made = draw(&self.out, &self.scene, self.only.as_deref())?;
        print!("{}", table(&made));
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

/// A technique, and what shows where it fails.
struct Subject {
    name: &'static str,
    storage: Option<Storage>,
    failure: Failure,
}

struct Failure {
    scene: fn() -> Scene,
    /// Texels per side of the light's map.
    map: u32,
    /// The technique as a command line has it; the subject's own where empty.
    technique: &'static str,
    storage: Option<Storage>,
}

/// Occluders behind each other, where bounds leak.
const STACK: Failure = Failure {
    scene: stacked_boards,
    map: 512,
    technique: "",
    storage: None,
};

/// Contacts in a map that is fine enough.
const CONTACT: Failure = Failure {
    scene: contacts,
    map: 512,
    technique: "",
    storage: None,
};

fn subjects() -> Vec<Subject> {
    let subject = |name, failure| Subject {
        name,
        storage: None,
        failure,
    };
    vec![
        subject(
            "binary",
            Failure {
                map: 160,
                ..CONTACT
            },
        ),
        subject(
            "pcf_gaussian",
            Failure {
                map: 160,
                technique: r#"{"pcf": {"box": {"radius": 1}}}"#,
                ..CONTACT
            },
        ),
        subject(
            "pcss",
            Failure {
                technique: r#"{"pcss": {"search_taps": 6, "filter_taps": 8}}"#,
                ..STACK
            },
        ),
        subject(
            "esm",
            Failure {
                technique: r#"{"esm": {"exponent": 30.0}}"#,
                ..CONTACT
            },
        ),
        subject("vsm", STACK),
        subject("evsm2", STACK),
        subject(
            "evsm4",
            Failure {
                storage: Some(Storage::Float16),
                ..STACK
            },
        ),
        subject("lvsm", STACK),
        subject("lvsm_lloyd", STACK),
        subject("convolution", CONTACT),
        subject("hamburger4", STACK),
        subject("hausdorff4", STACK),
    ]
}

/// A scene that is drawn for maps with several samples per texel and with one.
struct Stage {
    scene: Scene,
    frames: [Frame; 2],
    truth: PictureTruth,
    /// The truth for a light of some size.
    soft: Option<Vec<f32>>,
}

/// What was made.
struct Made {
    /// The technique's name.
    name: String,
    /// Bits per texel of the map on the common view; none where the plain depth map is read.
    bits: Option<u32>,
    /// Planes of that map.
    planes: u32,
    /// Mean absolute error over the lit side of surfaces, on the view and where the technique fails.
    errors: [f64; 2],
}

/// Makes the pictures of all techniques in `out`, with `view` as the common scene; of one, if it is named.
fn draw(out: &Path, view: &str, only: Option<&str>) -> Result<Vec<Made>, LabError> {
    let mut subjects = subjects();
    if let Some(only) = only {
        let names: Vec<&str> = subjects.iter().map(|subject| subject.name).collect();
        if !names.contains(&only) {
            return Err(LabError::unsuitable(
                only,
                format!(
                    "no technique of this name is pictured; the nearest are {}",
                    nearest(only, names)
                ),
            ));
        }
        subjects.retain(|subject| subject.name == only);
    }
    std::fs::create_dir_all(out).map_err(|source| PictureError::Unwritable {
        path: out.to_owned(),
        source,
    })?;
    let gpu = Gpu::open(Profile::NativeAdapter)?;
    let graph = GraphFile::parse("hard_shadows.json", GRAPH.to_owned(), None)?;
    let bar = progress::bar(subjects.len() as u64, "drawing");
    let mut common = Stage::new(&gpu, scene::load(view)?, MAP, &graph)?;
    let mut made = Vec::new();
    for subject in &subjects {
        let fails = &subject.failure;
        let mut stage = Stage::new(&gpu, place_on_ground((fails.scene)()), fails.map, &graph)?;
        let failing = match fails.technique {
            "" => subject.name,
            technique => technique,
        };
        let [on_view, failure] = [
            common.shade(&gpu, &graph, subject.name, subject.storage)?,
            stage.shade(&gpu, &graph, failing, fails.storage)?,
        ];
        let panels = [
            on_view.picture,
            on_view.difference,
            failure.picture,
            failure.difference,
        ];
        let path = out.join(format!("{}.png", subject.name));
        save_panels(&path, &panels, PANEL, 2)?;
        made.push(Made {
            name: subject.name.to_owned(),
            bits: on_view.bits,
            planes: on_view.planes,
            errors: [on_view.error, failure.error],
        });
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(made)
}

/// What was made, as a table.
fn table(made: &[Made]) -> String {
    let mut text = format!(
        "{:<14} {:>14} {:>7} {:>10} {:>10}\n",
        "technique", "bits per texel", "planes", "on view", "failing"
    );
    for made in made {
        let bits = made.bits.map_or("-".to_owned(), |bits| bits.to_string());
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "{:<14} {bits:>14} {:>7} {:>10.5} {:>10.5}",
            made.name, made.planes, made.errors[0], made.errors[1]
        );
    }
    text
}

/// A picture of a technique, its difference from the truth, and figures.
struct Shaded {
    picture: Vec<u8>,
    difference: Vec<u8>,
    error: f64,
    bits: Option<u32>,
    planes: u32,
}

impl Stage {
    fn new(gpu: &Gpu, scene: Scene, map: u32, graph: &GraphFile) -> Result<Self, LabError> {
        let options = RenderOptions {
            size: PANEL,
            map,
            ..RenderOptions::default()
        };
        let margin = graph.radius()?;
        let frame = |samples| {
            let options = RenderOptions {
                samples,
                ..options.clone()
            };
            options.frame(gpu, &scene, margin)
        };
        let frames = [frame(4)?, frame(1)?];
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
        let argument: TechniqueArgument = technique
            .parse()
            .map_err(|error| LabError::unsuitable(technique, format!("{error}")))?;
        let file = graph
            .with_technique_argument(&argument, storage)?
            .in_single_precision()?;
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
        let encoding = file.encoding().filter(|_| !file.reads_depth());
        Ok(Shaded {
            picture,
            difference: signed_difference(&found, truth, FULL_DIFFERENCE),
            error: error.facing.mean_absolute,
            bits: encoding.as_ref().map(|encoding| encoding.bits_per_texel()),
            planes: encoding.map_or(0, |encoding| encoding.planes()),
        })
    }

    /// Shadow intensity under a light of the usual size.
    fn area_light(&self, gpu: &Gpu) -> Result<Vec<f32>, LabError> {
        let frame = &self.frames[1];
        let desc = &frame.desc;
        let light = AreaLight::new(&self.scene, &desc.light, desc.shape, desc.map, USUAL_PLACES)?;
        Ok(light.picture(&read_gbuffer(gpu, &frame.surface)?)?)
    }
}
