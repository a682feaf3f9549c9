//! Files that are written whole or not at all.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process;

use super::CommandError;

/// A file that is being written beside the one that it becomes. It goes unless it is kept.
#[derive(Debug)]
pub struct Part {
    file: File,
    path: PathBuf,
    target: PathBuf,
}

impl Part {
    /// A new file beside `target`, as readable as any other.
    ///
    /// # Errors
    /// [`CommandError::Write`] if `target` is a folder, or lies in none that takes files.
    pub fn beside(target: &Path) -> Result<Self, CommandError> {
        if target.is_dir() {
            return Err(refused(target, "it is a folder; name a file in it"));
        }
        let mut number = 0_u32;
        loop {
            let name = format!(".moment-shadows-{}-{number}.part", process::id());
            let path = target.with_file_name(name);
            match File::create_new(&path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => number += 1,
                Err(error) => return Err(failed(target, &error)),
                Ok(file) => {
                    let target = target.to_owned();
                    return Ok(Self { file, path, target });
                }
            }
        }
    }

    /// Where it is for now.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Writes by `write`.
    ///
    /// # Errors
    /// [`CommandError::Write`].
    pub fn write(
        mut self,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<Self, CommandError> {
        write(&mut self.file).map_err(|error| failed(&self.target, &error))?;
        Ok(self)
    }

    /// Gives it its name, behind which nothing has changed until now.
    ///
    /// # Errors
    /// [`CommandError::Write`].
    pub fn keep(self) -> Result<(), CommandError> {
        // Some file systems find only now that they are full.
        let synced = self.file.sync_all();
        synced
            .and_then(|()| fs::rename(&self.path, &self.target))
            .map_err(|error| failed(&self.target, &error))
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        // What was kept has another name now.
        let _ = fs::remove_file(&self.path);
    }
}

/// Why a file could not be written.
fn failed(target: &Path, error: &io::Error) -> CommandError {
    let reason = if error.kind() == io::ErrorKind::NotFound {
        let folder = target.parent().unwrap_or(target).display();
        format!("the folder '{folder}' does not exist; create it first")
    } else if error.kind() == io::ErrorKind::StorageFull {
        "the disk is full; what was there is unchanged".to_owned()
    } else {
        format!("{error}; what was there is unchanged")
    };
    refused(target, reason)
}

fn refused(target: &Path, reason: impl Into<String>) -> CommandError {
    CommandError::Write {
        path: target.display().to_string(),
        reason: reason.into(),
    }
}
