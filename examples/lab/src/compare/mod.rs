//! Techniques that make pictures of a scene, compared: errors against a truth, pictures with differences, and costs.

mod cost;
mod report;
mod technique;

use std::path::{Path, PathBuf};
use std::time::Instant;

pub use self::cost::Cost;
pub use self::report::{Errors, Report, Row, Table};
pub use self::technique::Technique;
use crate::cost::clock::{Clock, ClockKind};
use crate::cost::protocol::FEWEST_ROUNDS;
use crate::cost::report::Conditions;
use crate::error::LabError;
use crate::frame::FrameDesc;
use crate::gpu::Gpu;
use crate::picture::{check_file, create_folder, save_atomically, save_panels, save_rgba};
use crate::progress;
use crate::scene::{self, Scene};

/// What is compared on which scenes, and what becomes of it.
#[derive(Clone, Debug, Default, PartialEq, clap::Args)]
pub struct Options {
    /// glTF or GLB files, or procedural scenes: fence-and-foliage, hall, chairs, edge, hole.
    #[arg(required = true)]
    pub scene: Vec<String>,
    /// Only the techniques of these names.
    #[arg(long)]
    pub only: Vec<String>,
    /// Also times the techniques, in so many rounds, at least 9.
    #[arg(long, value_name = "ROUNDS", num_args = 0..=1, require_equals = true, default_missing_value = "9", value_parser = clap::value_parser!(u32).range(9..=1000))]
    pub cost: Option<u32>,
    /// A folder for pictures of the truth and of each technique with its difference; it is made if need be.
    #[arg(long)]
    pub out: Option<PathBuf>,
    /// A file for the figures as JSON.
    #[arg(long)]
    pub json: Option<PathBuf>,
}

/// What a scene and a view give: what techniques read, and the truth of the picture that they make.
pub trait Stage {
    /// What makes the picture.
    type Candidate;
    /// What a candidate gives.
    type Picture;
    /// What a candidate is judged by.
    type Errors: Errors;

    /// What tables and files call a candidate.
    fn name(candidate: &Self::Candidate) -> &str;

    /// Creates what a candidate needs on the device.
    fn bind(&self, gpu: &Gpu, candidate: &Self::Candidate) -> Result<Box<dyn Technique>, LabError>;

    /// Reads the picture that a technique has made.
    fn read(&self, gpu: &Gpu, output: &wgpu::Texture) -> Result<Self::Picture, LabError>;

    /// How far a picture is from the truth.
    fn errors(
        &self,
        candidate: &Self::Candidate,
        picture: &Self::Picture,
    ) -> Result<Self::Errors, LabError>;

    /// The truth and each picture with its difference from the truth, as sRGB bytes with alpha.
    fn show(&self, gpu: &Gpu, pictures: &[Self::Picture]) -> Result<Shown, LabError>;

    /// What the report tells of it.
    fn setting(&self) -> String;

    /// What names of files begin with.
    fn stem(&self) -> String;

    /// What is drawn, and how large.
    fn desc(&self) -> &FrameDesc;

    /// Makes a candidate's picture.
    fn picture(&self, gpu: &Gpu, candidate: &Self::Candidate) -> Result<Self::Picture, LabError> {
        let bound = self.bind(gpu, candidate)?;
        bound.run(gpu)?;
        self.read(gpu, bound.output()?)
    }
}

/// Pictures for people, as sRGB bytes with alpha.
pub struct Shown {
    /// The truth.
    pub truth: Vec<u8>,
    /// Each candidate's picture and its difference.
    pub pictures: Vec<[Vec<u8>; 2]>,
}

/// Compares candidates on the stage that is made of each scene.
pub fn compare<S: Stage>(
    gpu: &Gpu,
    options: &Options,
    mut candidates: Vec<S::Candidate>,
    stage: impl Fn(&Scene) -> Result<S, LabError>,
) -> Result<Vec<Report<S::Errors>>, LabError> {
    let known: Vec<&str> = candidates.iter().map(S::name).collect();
    if let Some(name) = (options.only.iter()).find(|name| !known.contains(&name.as_str())) {
        let reason = format!(
            "no technique of this name is compared; there are {}",
            known.join(", ")
        );
        return Err(LabError::unsuitable(name, reason));
    }
    candidates
        .retain(|it| options.only.is_empty() || options.only.iter().any(|o| o == S::name(it)));
    if let Some(out) = &options.out {
        create_folder(out)?;
    }
    if let Some(json) = &options.json {
        check_file(json)?;
    }
    let mut reports = Vec::new();
    for name in &options.scene {
        let bar = progress::bar(candidates.len() as u64 + 1, name);
        let scene = scene::load(name)?;
        let begun = Instant::now();
        let stage = stage(&scene)?;
        let truth_seconds = begun.elapsed().as_secs_f64();
        bar.inc(1);
        let (mut rows, mut pictures, mut bound) = (Vec::new(), Vec::new(), Vec::new());
        for candidate in &candidates {
            let technique = stage.bind(gpu, candidate)?;
            technique.run(gpu)?;
            let picture = stage.read(gpu, technique.output()?)?;
            let name = S::name(candidate).to_owned();
            rows.push(Row {
                errors: stage.errors(candidate, &picture)?,
                name: name.clone(),
                cost: None,
            });
            pictures.push(picture);
            bound.push((name, technique));
            bar.inc(1);
        }
        bar.finish_and_clear();
        if let Some(out) = &options.out {
            let names: Vec<&str> = candidates.iter().map(S::name).collect();
            let shown = stage.show(gpu, &pictures)?;
            save(&out.join(stage.stem()), stage.desc().picture, &names, shown)?;
        }
        let mut conditions = None;
        if let Some(rounds) = options.cost {
            let clock = Clock::new(gpu, ClockKind::for_device(gpu));
            let bar = progress::bar(u64::from(rounds.max(FEWEST_ROUNDS)), "timing");
            let costs = cost::costs(&clock, stage.desc(), &bound, rounds, || bar.inc(1))?;
            bar.finish_and_clear();
            for (row, cost) in rows.iter_mut().zip(costs) {
                row.cost = Some(cost);
            }
            conditions = Some(Conditions::of(&clock, rounds));
        }
        reports.push(Report {
            setting: stage.setting(),
            truth_seconds,
            rows,
            conditions,
        });
    }
    if let Some(path) = &options.json {
        save_atomically(path, |file| {
            serde_json::to_writer_pretty(&mut *file, &reports)?;
            file.write_all(b"\n")
        })?;
    }
    Ok(reports)
}

/// Saves the truth, every candidate, its difference, and all of them together: `STEM-truth.png`, `STEM-NAME.png`,
/// `STEM-NAME-difference.png`, `STEM.png`. There the differences are below the pictures; with a single candidate all is in a row.
fn save(stem: &Path, size: [u32; 2], names: &[&str], shown: Shown) -> Result<(), LabError> {
    let named = |what: &str| {
        let mut path = stem.as_os_str().to_owned();
        path.push(what);
        PathBuf::from(path)
    };
    let save = |what: &str, picture: &[u8]| save_rgba(&named(what), size[0], size[1], picture);
    save("-truth.png", &shown.truth)?;
    let blank = vec![255; shown.truth.len()];
    let (mut panels, mut differences) = (vec![shown.truth], vec![blank]);
    for (name, [picture, difference]) in names.iter().zip(shown.pictures) {
        let name = name.replace(|letter: char| !letter.is_alphanumeric(), "-");
        save(&format!("-{name}.png"), &picture)?;
        save(&format!("-{name}-difference.png"), &difference)?;
        panels.push(picture);
        differences.push(difference);
    }
    let mut columns = panels.len() as u32;
    if names.len() == 1 {
        differences.remove(0);
        columns = 3;
    }
    panels.extend(differences);
    save_panels(&named(".png"), &panels, size, columns)
}
