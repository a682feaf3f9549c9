//! The trade between error, time and bytes: every technique and storage with maps, softness and samples, judged on a scene from several
//! views and timed in the same run.
//!
//! One truth serves all maps: it is made of the largest, with 64 samples per texel, so that a smaller map or fewer samples show as
//! error. An error is the mean absolute difference of shadow intensity, in tables in percent of full shadow.

pub mod axes;
pub mod best;
pub mod chart;
pub mod choose;
pub(crate) mod crop;
pub mod front;
pub mod held_out;
pub mod inspect;
pub mod interval;
mod isa;
mod jobs;
mod journal;
mod judge;
mod measure;
pub mod probe;
pub mod report;
pub mod results;
pub mod setup;
mod stage;

use std::path::Path;

use moment_shadows::Profile;

pub use crop::Crop;
pub use isa::Kept;
pub use jobs::Job;
pub use judge::Judged;
pub use measure::{Measured, Meter};
pub(crate) use stage::Drawn;
pub use stage::Stage;

use self::axes::{Axes, Cell};
use self::journal::{Finding, Journal};
use self::probe::ViewProbe;
use self::results::{JobResults, Results, Row, SceneResults, Setting, VERSION};
use self::setup::{SceneSetup, ViewSetup, path_beside};
use crate::cost::clock::FEATURES;
use crate::error::LabError;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::identity;
use crate::picture::save_atomically;
use crate::progress;
use crate::scene::{self, Scene};

/// The example of hard shadows.
const GRAPH: &str = include_str!("../../../hard_shadows.json");

/// What is traded.
#[derive(Clone, Debug)]
pub struct Trade {
    /// Files or names of scenes.
    pub scenes: Vec<String>,
    /// What is varied.
    pub axes: Axes,
    /// What the device offers.
    pub profile: Profile,
    /// Width and height of pictures.
    pub picture: [u32; 2],
    /// How many views are judged, and the number of the first. Scenes with a file of views have those.
    pub views: [u32; 2],
    /// Rounds of times, at least 9.
    pub rounds: u32,
    /// One surface in so many texels along either axis is judged.
    pub stride: u32,
    /// Whether a ground plane is added.
    pub ground: bool,
    /// What is compared.
    pub jobs: Vec<Job>,
}

/// The file of results in the folder of a finished trade.
const RESULTS: &str = "results.json";

/// Samples per texel that truths are made of.
pub(crate) const TRUTH_SAMPLES: u32 = 64;

impl Trade {
    /// The graph whose kernel, technique and storage are varied.
    pub fn graph() -> Result<GraphFile, LabError> {
        GraphFile::parse("hard_shadows.json", GRAPH.to_owned(), None)
    }

    /// Measures everything, or what an earlier run into the same folder left, and writes `results.json`, `report.html` and the charts
    /// into it.
    pub fn run(&self, folder: &Path) -> Result<Results, LabError> {
        let file = Self::graph()?;
        // What is wrong with a scene is said before the work.
        for scene in &self.scenes {
            self.load(scene)?;
            tell_of_views(scene)?;
        }
        let gpu = Gpu::open_with(self.profile, FEATURES)?;
        let setting = self.setting(&gpu)?;
        if let Some(finished) = self.finished(folder, &setting) {
            return Ok(finished);
        }
        let mut journal = Journal::open(folder, &setting)?;
        let meter = Meter::new(&gpu, Kept::read()?)?;
        let cells = self.axes.cells();
        let hard = self.jobs.contains(&Job::Hard);
        let rows = if hard {
            self.scenes.len() * cells.len()
        } else {
            0
        };
        let others = self.scenes.len() * (self.jobs.len() - usize::from(hard));
        let bar = progress::bar((rows + others) as u64, "trading");
        for name in self.scenes.iter().filter(|_| hard) {
            let left: Vec<Cell> = (cells.iter().copied())
                .filter(|cell| !is_found(&journal, name, *cell))
                .collect();
            bar.inc((cells.len() - left.len()) as u64);
            if left.is_empty() {
                continue;
            }
            bar.set_message(format!("{name}: truths"));
            let (scene, setups) = self.load(name)?;
            let source = (&file, &self.axes);
            let stage = Stage::of(&gpu, source, &setting, &scene).with_views(&setups)?;
            for probe in stage.views.iter().map(|view| view.probe.clone()) {
                if !probes(&journal.findings, name).any(|known| known.view == probe.view) {
                    let scene = name.clone();
                    journal.add(Finding::Probe { scene, probe })?;
                }
            }
            bar.set_message(name.clone());
            let mut drawn: Option<((u32, u32), Vec<Frame>)> = None;
            for cell in left {
                let size = (cell.map, cell.samples);
                if drawn.as_ref().is_none_or(|(of, _)| *of != size) {
                    // The old ones go before the new ones come.
                    drop(drawn.take());
                    drawn = Some((size, stage.frames(cell.map, cell.samples)?));
                }
                let Some((_, frames)) = &drawn else { continue };
                let measured = meter.measure(&stage, frames, cell)?;
                let crop = self.shows(cell).then(|| stage.crop(&measured, cell));
                journal.add(Finding::Row {
                    scene: name.clone(),
                    row: Box::new(measured.row),
                    crop: crop.transpose()?,
                })?;
                bar.inc(1);
            }
        }
        for job in self.jobs.iter().filter(|job| **job != Job::Hard) {
            for name in &self.scenes {
                bar.set_message(format!("{name}: {job}"));
                if !jobs::is_found(&journal, *job, name) {
                    journal.add(job.run(name, self.rounds, folder)?)?;
                }
                bar.inc(1);
            }
        }
        bar.finish_and_clear();
        let results = self.results(setting, &journal)?;
        let text = serde_json::to_string_pretty(&results)? + "\n";
        // Where there are results, there is everything else.
        report::save(folder, &results, &journal.findings)?;
        save_atomically(&folder.join(RESULTS), |out| out.write_all(text.as_bytes()))?;
        journal.finish()?;
        Ok(results)
    }

    /// What the views of a scene ask for, without measuring anything else.
    pub fn probe(&self, name: &str) -> Result<Vec<ViewProbe>, LabError> {
        let file = Self::graph()?;
        let gpu = Gpu::open(self.profile)?;
        let setting = self.setting(&gpu)?;
        let (scene, setups) = self.load(name)?;
        tell_of_views(name)?;
        Stage::of(&gpu, (&file, &self.axes), &setting, &scene).probes(&setups)
    }

    /// The results in a folder, if they are of the same setting, scenes and jobs.
    fn finished(&self, folder: &Path, setting: &Setting) -> Option<Results> {
        let text = std::fs::read_to_string(folder.join(RESULTS)).ok()?;
        let found: Results = serde_json::from_str(&text).ok()?;
        let scenes = found.scenes.iter().map(|scene| &scene.scene);
        let same = scenes.eq(&self.scenes) && found.setting == *setting;
        let hard_alone = self.jobs.as_slice() == [Job::Hard];
        Some(found).filter(|_| same && hard_alone)
    }

    /// Whether the picture of a combination is shown: those with the largest map and the most samples.
    pub(crate) fn shows(&self, cell: Cell) -> bool {
        let most = self.axes.samples.iter().copied().max().unwrap_or(1);
        let samples = match self.axes.candidates[cell.candidate].reads_depth() {
            true => 1,
            false => most,
        };
        cell.map == self.axes.largest_map() && cell.samples == samples
    }

    /// A scene with its views.
    pub(crate) fn load(&self, name: &str) -> Result<(Scene, Vec<ViewSetup>), LabError> {
        let given = SceneSetup::beside(name)?;
        let mut scene = scene::load(name)?;
        if !self.ground || given.as_ref().is_some_and(|given| !given.ground) {
            scene = scene.without_ground();
        }
        if scene.casters().next().is_none() {
            let reason = "it has no triangle that could cast a shadow";
            return Err(LabError::unsuitable(name, reason));
        }
        let [count, first] = self.views;
        let setups = match given {
            Some(given) => given.judged(),
            None => (first..first + count).map(ViewSetup::Numbered).collect(),
        };
        Ok((scene, setups))
    }

    pub(crate) fn setting(&self, gpu: &Gpu) -> Result<Setting, LabError> {
        let info = gpu.adapter.get_info();
        Ok(Setting {
            library: env!("CARGO_PKG_VERSION").to_owned(),
            of: identity::identity(&self.scenes)?,
            adapter: gpu.described(),
            profile: self.profile.name().to_owned(),
            is_software: info.device_type == wgpu::DeviceType::Cpu,
            picture: self.picture,
            views: self.views,
            truth_samples: TRUTH_SAMPLES,
            truth_map: self.axes.largest_map(),
            stride: self.stride,
            rounds: self.rounds,
            ground: self.ground,
            axes: self.axes.described(),
        })
    }

    /// The findings in the order of the axes.
    fn results(&self, setting: Setting, journal: &Journal) -> Result<Results, LabError> {
        let cells = self.axes.cells();
        let mut scenes = Vec::new();
        for name in &self.scenes {
            let (scene, _) = self.load(name)?;
            let row_of = |cell: &Cell| rows(&journal.findings, name).find(|row| row.cell == *cell);
            scenes.push(SceneResults {
                scene: name.clone(),
                triangles: scene.triangles(),
                probes: probes(&journal.findings, name).cloned().collect(),
                rows: cells.iter().filter_map(row_of).cloned().collect(),
            });
        }
        Ok(Results {
            version: VERSION,
            setting,
            scenes,
            jobs: journal.findings.iter().filter_map(job_of).collect(),
        })
    }
}

/// Says that a scene's own views are taken, which arguments about views do not change.
pub(crate) fn tell_of_views(scene: &str) -> Result<(), LabError> {
    if let Some(given) = SceneSetup::beside(scene)? {
        let file = path_beside(scene);
        eprintln!(
            "{scene}: the {} views of {} are judged, whatever else is said of views",
            given.judged().len(),
            file.display()
        );
    }
    Ok(())
}

/// What a finding says of another job.
fn job_of(finding: &Finding) -> Option<JobResults> {
    match finding {
        Finding::Job {
            job, scene, report, ..
        } => Some(JobResults {
            job: job.clone(),
            scene: scene.clone(),
            report: report.clone(),
        }),
        Finding::Row { .. } | Finding::Probe { .. } => None,
    }
}

/// The rows that were found on a scene.
fn rows<'a>(findings: &'a [Finding], name: &'a str) -> impl Iterator<Item = &'a Row> {
    findings.iter().filter_map(move |finding| match finding {
        Finding::Row { scene, row, .. } if scene == name => Some(&**row),
        _ => None,
    })
}

/// What the views of a scene ask for.
fn probes<'a>(findings: &'a [Finding], name: &'a str) -> impl Iterator<Item = &'a ViewProbe> {
    findings.iter().filter_map(move |finding| match finding {
        Finding::Probe { scene, probe } if scene == name => Some(probe),
        _ => None,
    })
}

fn is_found(journal: &Journal, scene: &str, cell: Cell) -> bool {
    rows(&journal.findings, scene).any(|row| row.cell == cell)
}
