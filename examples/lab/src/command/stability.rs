//! `moment-shadows-lab stability`: every technique with every storage on inputs of all kinds.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use moment_shadows::{MapEncoding, Profile, Storage, nearest};

use super::CommandResult;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::picture::{create_folder, save_atomically};
use crate::progress;
use crate::stability::report::Report;
use crate::stability::unfinished::Unfinished;
use crate::stability::{self, Effort, Progress, plot};
use crate::techniques::{STORAGES, filterable, label};

/// What `stability` takes.
#[derive(clap::Args)]
pub struct Options {
    /// Tries a hundredth of the inputs, and shorter climbs.
    #[arg(long)]
    quick: bool,
    /// A folder for the report as text, JSON and a picture; it is made if need be. Until then it has the counts so far.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Goes on with the run in the folder if there is one that was stopped; the report is the same.
    #[arg(long, requires = "out")]
    resume: bool,
    /// Only this technique.
    #[arg(long, value_parser = technique)]
    technique: Option<String>,
    /// Only this storage.
    #[arg(long, value_parser = STORAGES.map(Storage::name))]
    storage: Option<String>,
    /// Inputs per technique and storage in place of 10000000, or of 100000 if quick.
    #[arg(long, value_parser = clap::value_parser!(u64).range(10..=1_000_000_000))]
    inputs: Option<u64>,
    /// Seed of the random inputs: the same seed gives the same inputs.
    #[arg(long, default_value_t = Effort::FULL.seed)]
    seed: u64,
}

/// The exit code where there is a fault; errors that prevent a report have 1, wrong arguments 2.
const FAULT_CODE: u8 = 3;

impl Options {
    /// Prints the report; ends with 3 where there is a fault.
    pub fn run(self) -> CommandResult {
        let usual = if self.quick {
            Effort::QUICK
        } else {
            Effort::FULL
        };
        let effort = Effort {
            inputs: self.inputs.unwrap_or(usual.inputs),
            seed: self.seed,
            ..usual
        };
        let pairs = pairs(self.technique.as_deref(), self.storage.as_deref())?;
        let report = report(&pairs, effort, self.out.as_deref(), self.resume)?;
        print!("{report}");
        Ok(match report.faults() {
            0 => ExitCode::SUCCESS,
            _ => ExitCode::from(FAULT_CODE),
        })
    }
}

/// The label of a technique with a filterable map.
fn technique(text: &str) -> Result<String, String> {
    let mut labels: Vec<String> = filterable()
        .iter()
        .map(|pair| label(pair.technique()))
        .collect();
    labels.sort();
    labels.dedup();
    if labels.iter().any(|label| label == text) {
        return Ok(text.to_owned());
    }
    let meant = nearest(text, labels.iter().map(String::as_str));
    Err(format!("the nearest techniques are {meant}"))
}

/// The pairs of a technique, a storage, both or neither.
pub fn pairs(technique: Option<&str>, storage: Option<&str>) -> Result<Vec<MapEncoding>, LabError> {
    let of_technique: Vec<MapEncoding> = filterable()
        .into_iter()
        .filter(|pair| technique.is_none_or(|name| label(pair.technique()) == name))
        .collect();
    let names: Vec<&str> = of_technique
        .iter()
        .map(|pair| pair.storage().name())
        .collect();
    let legal = names.join(" or ");
    let pairs: Vec<MapEncoding> = of_technique
        .into_iter()
        .filter(|pair| storage.is_none_or(|name| pair.storage().name() == name))
        .collect();
    if pairs.is_empty() {
        let technique = technique.unwrap_or("any technique");
        let storage = storage.unwrap_or("any storage");
        let reason = format!("it is not stored as {storage}; it is as {legal}");
        return Err(LabError::unsuitable(technique, reason));
    }
    Ok(pairs)
}

/// Makes the report of some pairs, and writes it into the folder `out` as text, JSON and a picture.
fn report(
    pairs: &[MapEncoding],
    effort: Effort,
    out: Option<&Path>,
    resume: bool,
) -> Result<Report, LabError> {
    let gpu = Gpu::open(Profile::WebgpuCore)?;
    let mut progress = Progress::none(pairs.len());
    let mut unfinished = None;
    if let Some(out) = out {
        // Before the work, which takes minutes.
        create_folder(out)?;
        let (file, found) = Unfinished::open(out, &gpu, pairs, effort, resume)?;
        (unfinished, progress) = (Some(file), found);
    }
    let keep = |progress: &Progress| match &mut unfinished {
        Some(file) => file.keep(progress),
        None => Ok(()),
    };
    let bar = progress::bar(stability::steps(pairs.len(), effort), "trying inputs");
    let report = stability::run(&gpu, pairs, effort, progress, keep, |count| bar.inc(count))?;
    bar.finish_and_clear();
    if let Some(out) = out {
        let text = report.to_string();
        save_atomically(&out.join("stability.txt"), |file| {
            file.write_all(text.as_bytes())
        })?;
        let json = serde_json::to_string_pretty(&report)?;
        save_atomically(&out.join("stability.json"), |file| {
            file.write_all(json.as_bytes())
        })?;
        plot::chart(&report).save(out, "stability")?;
    }
    if let Some(file) = unfinished {
        file.finish()?;
    }
    Ok(report)
}
