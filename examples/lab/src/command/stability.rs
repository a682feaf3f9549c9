//! `moment-shadows stability`: every technique with every storage on inputs of all kinds.

use std::path::Path;

use moment_shadows::{MapEncoding, Profile};

use crate::gpu::Gpu;
use crate::picture::{PictureError, save_atomically};
use crate::progress;
use crate::stability::report::Report;
use crate::stability::{self, Effort, StabilityError, plot};
use crate::techniques::{filterable, label};

/// The exit code where there is a fault; errors that prevent a report have 1, wrong arguments 2.
pub const FAULT_CODE: u8 = 3;

/// The labels of all techniques.
#[must_use]
pub fn techniques() -> Vec<String> {
    let mut labels: Vec<String> = filterable()
        .iter()
        .map(|pair| label(pair.technique()))
        .collect();
    labels.sort();
    labels.dedup();
    labels
}

/// The pairs of a technique, a storage, both or neither.
pub fn pairs(
    technique: Option<&str>,
    storage: Option<&str>,
) -> Result<Vec<MapEncoding>, StabilityError> {
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
        return Err(StabilityError::NoPair {
            technique: technique.unwrap_or("any technique").to_owned(),
            storage: storage.unwrap_or("any storage").to_owned(),
            legal,
        });
    }
    Ok(pairs)
}

/// Makes the report of some pairs, and writes it into the folder `out` as text, JSON and a picture.
pub fn run(
    pairs: &[MapEncoding],
    effort: Effort,
    out: Option<&Path>,
) -> Result<Report, StabilityError> {
    let gpu = Gpu::open(Profile::WebgpuCore)?;
    if let Some(out) = out {
        // Before the work, which takes minutes.
        std::fs::create_dir_all(out).map_err(|source| PictureError::Unwritable {
            path: out.to_owned(),
            source,
        })?;
    }
    let bar = progress::bar(stability::steps(pairs.len(), effort), "trying inputs");
    let report = stability::run(&gpu, pairs, effort, || bar.inc(1))?;
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
        plot::save(&report, out)?;
    }
    Ok(report)
}
