//! What is compared besides hard shadows: soft shadows of area lights, and light in the air.

use std::path::Path;

use super::journal::{Finding, Journal};
use crate::command::argument::defaults;
use crate::command::{scattering_error, soft_error};
use crate::compare::{Errors, Options, Report};
use crate::error::LabError;

/// A kind of shadow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum Job {
    /// Hard shadows, filtered: all axes.
    Hard,
    /// Soft shadows of an area light, against the sampled light, with pictures in the folder `soft`.
    Soft,
    /// Light that a medium scatters, against marched rays, with pictures in the folder `air`.
    Air,
}

impl Job {
    /// The name on command lines and of the folder.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Job::Hard => "hard",
            Job::Soft => "soft",
            Job::Air => "air",
        }
    }

    /// Compares on a scene, and puts pictures into a folder of the job's name.
    pub(super) fn run(self, scene: &str, rounds: u32, folder: &Path) -> Result<Finding, LabError> {
        let compare = Options {
            scene: vec![scene.to_owned()],
            cost: Some(rounds),
            out: Some(folder.join(self.name())),
            ..Options::default()
        };
        match self {
            Job::Hard => Err(LabError::refused("hard shadows are no further job")),
            Job::Soft => {
                let options = soft_error::SoftErrorOptions {
                    compare,
                    ..defaults_of(scene)
                };
                self.found(scene, &soft_error::run(&options)?)
            }
            Job::Air => {
                let options = scattering_error::ScatteringErrorOptions {
                    compare,
                    ..defaults_of(scene)
                };
                self.found(scene, &scattering_error::run(&options)?)
            }
        }
    }

    fn found<E: Errors>(self, scene: &str, reports: &[Report<E>]) -> Result<Finding, LabError> {
        let text: Vec<String> = reports.iter().map(ToString::to_string).collect();
        Ok(Finding::Job {
            job: self.name().to_owned(),
            scene: scene.to_owned(),
            report: serde_json::to_value(reports)?,
            text: text.join("\n"),
        })
    }
}

/// What a comparison takes where nothing is given but a scene.
fn defaults_of<A: clap::Args>(scene: &str) -> A {
    defaults(&[scene])
}

pub(super) fn is_found(journal: &Journal, job: Job, name: &str) -> bool {
    journal.findings.iter().any(|finding| match finding {
        Finding::Job { job: of, scene, .. } => of == job.name() && scene == name,
        Finding::Row { .. } | Finding::Probe { .. } => false,
    })
}

impl core::fmt::Display for Job {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.name())
    }
}
