//! What has been tried so far, so that a run that was stopped goes on where it was, with the same result to the bit.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use moment_shadows::MapEncoding;
use serde::{Deserialize, Serialize};

use super::judge::Tally;
use super::{Effort, Progress};
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::identity;
use crate::picture::save_atomically;
use crate::techniques::label;

/// The file in the folder of a run that is not finished.
const NAME: &str = "unfinished.json";

/// How often it is written at most.
const EVERY: Duration = Duration::from_secs(20);

/// What two runs must have in common for their counts to belong together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Setting {
    /// The beginning of the SHA-256 of the command.
    build: String,
    adapter: String,
    pairs: Vec<String>,
    #[serde(flatten)]
    effort: Effort,
}

impl Setting {
    /// What is different in a file's setting.
    fn differences(&self, file: &Self) -> Vec<String> {
        let here = self.described();
        let there = file.described();
        let all = here.into_iter().zip(there);
        all.filter(|(here, there)| here != there)
            .map(|((name, here), (_, there))| format!("{name} was {there} and is {here}"))
            .collect()
    }

    fn described(&self) -> [(&'static str, String); 6] {
        [
            ("the build", self.build.clone()),
            ("the adapter", self.adapter.clone()),
            ("the list of pairs", self.pairs.join(", ")),
            ("the number of inputs", self.effort.inputs.to_string()),
            ("the number of steps", self.effort.steps.to_string()),
            ("the seed", self.effort.seed.to_string()),
        ]
    }
}

/// All that the file has.
#[derive(Serialize, Deserialize)]
struct Content {
    setting: Setting,
    next: u64,
    tallies: Vec<Tally>,
}

/// The file, until the run is finished.
pub struct Unfinished {
    path: PathBuf,
    setting: Setting,
    written: Option<Instant>,
}

impl Unfinished {
    /// The file in a folder, and what there is of the run. What an earlier run left is refused unless it is to go on, and is of the
    /// same setting.
    pub fn open(
        folder: &Path,
        gpu: &Gpu,
        pairs: &[MapEncoding],
        effort: Effort,
        resume: bool,
    ) -> Result<(Self, Progress), LabError> {
        let setting = Setting {
            build: identity::of_command()?,
            adapter: gpu.described(),
            pairs: pairs
                .iter()
                .map(|pair| format!("{} {}", label(pair.technique()), pair.storage()))
                .collect(),
            effort,
        };
        Self::open_of(folder, setting, resume)
    }

    fn open_of(
        folder: &Path,
        setting: Setting,
        resume: bool,
    ) -> Result<(Self, Progress), LabError> {
        let path = folder.join(NAME);
        let unusable = |reason: String| {
            let way = "remove it to begin anew, or name another folder";
            LabError::unsuitable(path.display(), format!("{reason}; {way}"))
        };
        let progress = match std::fs::read_to_string(&path) {
            Err(error) if error.kind() == ErrorKind::NotFound => {
                Progress::none(setting.pairs.len())
            }
            Err(error) => return Err(unusable(error.to_string())),
            Ok(_) if !resume => {
                let reason = "it is of a run that was stopped; --resume goes on with it";
                return Err(unusable(reason.to_owned()));
            }
            Ok(text) => {
                let content: Content = serde_json::from_str(&text)
                    .map_err(|error| unusable(format!("it is no state of a run: {error}")))?;
                let differences = setting.differences(&content.setting);
                if !differences.is_empty() {
                    let reason = format!("it is of another run: {}", differences.join(", "));
                    return Err(unusable(reason));
                }
                Progress::of(setting.pairs.len(), content.next, content.tallies)
                    .ok_or_else(|| unusable("its counts are not those of its pairs".to_owned()))?
            }
        };
        let this = Self {
            path,
            setting,
            written: None,
        };
        Ok((this, progress))
    }

    /// Writes what there is, unless that was done within the last 20 seconds.
    pub fn keep(&mut self, progress: &Progress) -> Result<(), LabError> {
        if self.written.is_some_and(|since| since.elapsed() < EVERY) {
            return Ok(());
        }
        let content = Content {
            setting: self.setting.clone(),
            next: progress.next,
            tallies: progress.tallies.clone(),
        };
        let text = serde_json::to_string(&content)? + "\n";
        save_atomically(&self.path, |file| file.write_all(text.as_bytes()))?;
        self.written = Some(Instant::now());
        Ok(())
    }

    /// Removes the file: everything is in the report.
    pub fn finish(self) -> Result<(), LabError> {
        match std::fs::remove_file(&self.path) {
            Err(error) if error.kind() != ErrorKind::NotFound => {
                Err(LabError::unsuitable(self.path.display(), error))
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::input::Input;
    use super::super::strata::Stratum;
    use super::*;

    fn setting() -> Setting {
        Setting {
            build: "b".to_owned(),
            adapter: "a".to_owned(),
            pairs: vec!["vsm".to_owned()],
            effort: Effort::QUICK,
        }
    }

    #[test]
    fn what_is_kept_is_read_again_to_the_bit() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let (mut file, mut progress) = Unfinished::open_of(folder.path(), setting(), true)?;
        let input = Input {
            fragment_depth: f32::NAN,
            weights: [f32::INFINITY, -0.0, 1e-45, 0.1, 0.0, 0.0, 0.0, 0.0],
            ..Input::default()
        };
        let tally = &mut progress.tallies[0];
        tally.add(Stratum::InvalidTexel, &input, None, f32::NAN);
        tally.add(Stratum::Diracs, &input, Some(0.1 + 0.2), 0.1);
        tally.add(Stratum::Slope, &Input::default(), Some(1.0 / 3.0), 0.7);
        progress.next = 7;
        file.keep(&progress)?;
        let (file, read) = Unfinished::open_of(folder.path(), setting(), true)?;
        assert_eq!(format!("{read:?}"), format!("{progress:?}"));
        file.finish()?;
        assert!(std::fs::read_dir(folder.path())?.next().is_none());
        Ok(())
    }

    #[test]
    fn a_state_of_another_run_is_refused_and_it_is_said_what_differs()
    -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let (mut file, progress) = Unfinished::open_of(folder.path(), setting(), false)?;
        file.keep(&progress)?;
        let effort = |inputs, steps, seed| Setting {
            effort: Effort {
                inputs,
                steps,
                seed,
            },
            ..setting()
        };
        let others = [
            (effort(100_001, 20, 1), "inputs was 100000 and is 100001"),
            (effort(100_000, 21, 1), "steps was 20 and is 21"),
            (effort(100_000, 20, 2), "the seed was 1 and is 2"),
            (
                Setting {
                    build: "c".to_owned(),
                    ..setting()
                },
                "the build was b and is c",
            ),
            (
                Setting {
                    adapter: "c".to_owned(),
                    ..setting()
                },
                "the adapter was a and is c",
            ),
            (
                Setting {
                    pairs: vec!["esm".to_owned()],
                    ..setting()
                },
                "pairs was vsm and is esm",
            ),
        ];
        let refused = |setting: Setting, resume| {
            let error = Unfinished::open_of(folder.path(), setting, resume).err();
            error.map(|error| error.to_string()).unwrap_or_default()
        };
        for (other, expected) in others {
            let said = refused(other, true);
            assert!(said.contains(expected), "{said}");
            assert_eq!(said.matches(" was ").count(), 1, "{said}");
        }
        let said = refused(setting(), false);
        assert!(said.contains("--resume goes on with it"), "{said}");
        assert_eq!(refused(setting(), true), "");
        std::fs::write(folder.path().join(NAME), "{}")?;
        let said = refused(setting(), true);
        assert!(said.contains("it is no state of a run"), "{said}");
        Ok(())
    }
}
