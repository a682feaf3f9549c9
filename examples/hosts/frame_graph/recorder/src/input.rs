//! What the frame graph's process wrote.

use std::fs;
use std::path::{Path, PathBuf};

use moment_shadows_graph::Plan;

use crate::error::RecorderError;

/// A plan, and the folder with what goes with it.
pub(crate) struct Input {
    pub(crate) name: String,
    pub(crate) plan: Plan,
    folder: PathBuf,
}

impl Input {
    pub(crate) fn all(folder: &str) -> Result<Vec<Self>, RecorderError> {
        let folder = Path::new(folder);
        let listed = fs::read_dir(folder).map_err(|error| failed(folder, error))?;
        let mut folders = Vec::new();
        for entry in listed {
            folders.push(entry.map_err(|error| failed(folder, error))?.path());
        }
        folders.sort();
        folders.into_iter().map(Self::read).collect()
    }

    fn read(folder: PathBuf) -> Result<Self, RecorderError> {
        let path = folder.join("plan.json");
        let text = fs::read(&path).map_err(|error| failed(&path, error))?;
        let plan = serde_json::from_slice(&text);
        Ok(Self {
            name: folder.file_name().unwrap_or_default().display().to_string(),
            plan: plan.map_err(|source| RecorderError::Plan { path, source })?,
            folder,
        })
    }

    pub(crate) fn bytes(&self, name: &str) -> Result<Vec<u8>, RecorderError> {
        let path = self.folder.join(name);
        fs::read(&path).map_err(|error| failed(&path, error))
    }

    pub(crate) fn text(&self, name: &str) -> Result<String, RecorderError> {
        Ok(String::from_utf8_lossy(&self.bytes(name)?).into_owned())
    }
}

fn failed(path: &Path, source: std::io::Error) -> RecorderError {
    let path = path.to_owned();
    RecorderError::File { path, source }
}
