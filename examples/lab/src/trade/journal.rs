//! What has been found so far, so that a trade that was stopped goes on where it was.
//!
//! A line per finding. The last one may be torn: what follows the last end of a line was never finished, and is found again.

use std::fs::{File, OpenOptions};
use std::io::{Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::crop::Crop;
use super::probe::ViewProbe;
use super::results::{Row, Setting};
use crate::error::LabError;

/// The file of findings in the folder of a trade that is not finished.
pub(super) const NAME: &str = "unfinished.jsonl";

/// One line after the first.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", tag = "found")]
pub(super) enum Finding {
    /// A row of hard shadows.
    Row {
        scene: String,
        row: Box<Row>,
        crop: Option<Crop>,
    },
    /// What a view of a scene asks for.
    Probe { scene: String, probe: ViewProbe },
    /// What another job compared on a scene.
    Job {
        job: String,
        scene: String,
        report: Value,
        text: String,
    },
}

/// Findings, in a file that grows.
pub(super) struct Journal {
    path: PathBuf,
    file: File,
    /// All findings, those of earlier runs first.
    pub(super) findings: Vec<Finding>,
}

impl Journal {
    /// The journal in a folder: with what an earlier run of the same setting found there, or a new one. One of another setting is
    /// refused, since its times and errors do not belong beside these.
    pub(super) fn open(folder: &Path, setting: &Setting) -> Result<Self, LabError> {
        let path = folder.join(NAME);
        let unusable = |reason: String| LabError::unsuitable(path.display(), reason);
        let first = serde_json::to_string(setting)? + "\n";
        let text = match std::fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
            Err(error) => return Err(unusable(error.to_string())),
        };
        let whole = &text[..text.rfind('\n').map_or(0, |end| end + 1)];
        let mut lines = whole.lines();
        let mut findings = Vec::new();
        if let Some(line) = lines.next() {
            let found = serde_json::from_str::<Setting>(line).ok();
            if found.as_ref() != Some(setting) {
                let way = "it is of another setting, device or version; remove it to begin anew, or name another folder";
                return Err(unusable(way.to_owned()));
            }
            for (number, line) in (2..).zip(lines) {
                let finding = serde_json::from_str(line)
                    .map_err(|error| unusable(format!("line {number} is no finding: {error}")))?;
                findings.push(finding);
            }
        }
        let failed = |error: std::io::Error| LabError::unsuitable(path.display(), error);
        let mut file = (OpenOptions::new().create(true).truncate(false).write(true))
            .open(&path)
            .map_err(failed)?;
        let written = if whole.is_empty() {
            file.set_len(0)
                .and_then(|()| file.write_all(first.as_bytes()))
        } else {
            // Without a torn line at the end.
            let end = whole.len() as u64;
            file.set_len(end)
                .and_then(|()| file.seek(SeekFrom::End(0)).map(drop))
        };
        written.map_err(failed)?;
        Ok(Self {
            path,
            file,
            findings,
        })
    }

    /// Adds a finding; it is in the file when this returns, and nothing of it if that fails.
    pub(super) fn add(&mut self, finding: Finding) -> Result<(), LabError> {
        let line = serde_json::to_string(&finding)? + "\n";
        let failed = |error: std::io::Error| {
            let way = "what was found so far is kept; run it again with the same folder to go on";
            LabError::unsuitable(self.path.display(), format!("{error}; {way}"))
        };
        let end = self.file.stream_position().map_err(failed)?;
        if let Err(error) = self.file.write_all(line.as_bytes()) {
            // A torn line would be left out by the next run, too.
            let _ = self.file.set_len(end);
            return Err(failed(error));
        }
        self.findings.push(finding);
        Ok(())
    }

    /// Removes the file: everything is in the results.
    pub(super) fn finish(self) -> Result<(), LabError> {
        std::fs::remove_file(&self.path)
            .map_err(|error| LabError::unsuitable(self.path.display(), error))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn setting(rounds: u32) -> Setting {
        Setting {
            rounds,
            ..Setting::default()
        }
    }

    fn finding(scene: &str) -> Finding {
        Finding::Job {
            job: "soft".to_owned(),
            scene: scene.to_owned(),
            report: Value::Null,
            text: String::new(),
        }
    }

    fn scenes(journal: &Journal) -> Vec<&str> {
        let findings = journal.findings.iter();
        let scenes = findings.map(|finding| match finding {
            Finding::Row { scene, .. }
            | Finding::Probe { scene, .. }
            | Finding::Job { scene, .. } => scene.as_str(),
        });
        scenes.collect()
    }

    #[test]
    fn a_torn_line_is_found_again_and_what_is_whole_is_kept()
    -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        let mut journal = Journal::open(folder.path(), &setting(9))?;
        journal.add(finding("one"))?;
        journal.add(finding("two"))?;
        drop(journal);
        let path = folder.path().join(NAME);
        let text = std::fs::read_to_string(&path)?;
        std::fs::write(&path, &text[..text.len() - 3])?;
        let mut journal = Journal::open(folder.path(), &setting(9))?;
        assert_eq!(scenes(&journal), ["one"]);
        journal.add(finding("three"))?;
        drop(journal);
        let journal = Journal::open(folder.path(), &setting(9))?;
        assert_eq!(scenes(&journal), ["one", "three"]);
        journal.finish()?;
        assert!(!path.exists());
        Ok(())
    }

    #[test]
    fn another_setting_and_other_files_are_refused() -> Result<(), Box<dyn std::error::Error>> {
        let folder = tempfile::tempdir()?;
        drop(Journal::open(folder.path(), &setting(9))?);
        let refused = Journal::open(folder.path(), &setting(10))
            .err()
            .map(|it| it.to_string());
        assert!(refused.unwrap_or_default().contains("another setting"));
        let path = folder.path().join(NAME);
        let first = std::fs::read_to_string(&path)?;
        std::fs::write(&path, first + "{}\n")?;
        let refused = Journal::open(folder.path(), &setting(9))
            .err()
            .map(|it| it.to_string());
        assert!(refused.unwrap_or_default().contains("line 2 is no finding"));
        Ok(())
    }
}
