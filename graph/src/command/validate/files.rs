//! The files that paths stand for.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::command::CommandError;

/// Each file of `paths`, and of each folder every WGSL and WESL file below it, by name.
pub(super) fn all(paths: &[PathBuf]) -> Result<Vec<PathBuf>, CommandError> {
    let mut found = Vec::new();
    for path in paths {
        if path.is_dir() {
            found.extend(below(path)?);
        } else {
            found.push(path.clone());
        }
    }
    Ok(found)
}

/// Every WGSL and WESL file below a folder, by name.
pub(super) fn below(folder: &Path) -> Result<Vec<PathBuf>, CommandError> {
    let failed = |source| CommandError::Read {
        path: folder.display().to_string(),
        source,
    };
    let mut found = Vec::new();
    let mut waiting = vec![folder.to_owned()];
    while let Some(folder) = waiting.pop() {
        for entry in fs::read_dir(&folder).map_err(failed)? {
            let entry = entry.map_err(failed)?;
            let path = entry.path();
            // A link to a folder may lead back to where it lies.
            if entry.file_type().map_err(failed)?.is_dir() {
                waiting.push(path);
            } else if path
                .extension()
                .is_some_and(|end| end == "wgsl" || end == "wesl")
            {
                found.push(path);
            }
        }
    }
    if found.is_empty() {
        let none = io::Error::new(
            io::ErrorKind::NotFound,
            "the folder has no file that ends in .wgsl or .wesl",
        );
        return Err(failed(none));
    }
    found.sort();
    Ok(found)
}
