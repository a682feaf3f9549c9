//! Modules of a project's own, from files.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use moment_shadows::{Source, ValidationReport};

use super::files;
use crate::command::{CommandError, read};

/// Modules by the paths that they are imported by.
pub(super) struct Modules {
    of: BTreeMap<String, Module>,
}

struct Module {
    file: PathBuf,
    text: String,
}

impl Modules {
    /// Reads what `--module` names: folders and files, each perhaps with a name and `=` before it.
    pub(super) fn read(named: &[String]) -> Result<Self, CommandError> {
        let mut modules = Self {
            of: BTreeMap::new(),
        };
        for named in named {
            let (name, path) = match named.split_once('=') {
                Some((name, path)) => (Some(name), Path::new(path)),
                None => (None, Path::new(named)),
            };
            if path.is_dir() {
                let root = match name {
                    Some(name) => name.to_owned(),
                    None => folder_name(path)?,
                };
                for file in files::below(path)? {
                    let inside = file.strip_prefix(path).unwrap_or(&file).with_extension("");
                    let parts = inside.iter().map(|part| part.to_string_lossy());
                    let parts = core::iter::once(root.clone().into()).chain(parts);
                    let parts: Vec<_> = parts.collect();
                    modules.add(parts.join("::"), file)?;
                }
            } else {
                let name = match name {
                    Some(name) => name.to_owned(),
                    None => {
                        let stem = path.file_stem().unwrap_or_default().to_string_lossy();
                        let folder = path.parent().unwrap_or(Path::new(""));
                        format!("{}::{stem}", folder_name(folder)?)
                    }
                };
                modules.add(name, path.to_owned())?;
            }
        }
        Ok(modules)
    }

    fn add(&mut self, name: String, file: PathBuf) -> Result<(), CommandError> {
        if let Some(first) = self.of.get(&name) {
            return Err(CommandError::Module {
                path: file.display().to_string(),
                reason: format!(
                    "it would be imported as `{name}`, as {} is; give one another name by `--module NAME=PATH`",
                    first.file.display()
                ),
            });
        }
        let text = read::read(&file, ValidationReport::LONGEST_SHADER)?;
        self.of.insert(name, Module { file, text });
        Ok(())
    }

    /// The modules as the library takes them.
    pub(super) fn sources(&self) -> Vec<Source<'_>> {
        let sources = self.of.iter().map(|(name, module)| Source {
            name,
            text: &module.text,
        });
        sources.collect()
    }

    /// Puts files in the places of modules.
    pub(super) fn name_files(&self, report: &mut ValidationReport) {
        for error in report.errors.iter_mut().chain(&mut report.warnings) {
            for place in &mut error.places {
                if let Some(module) = self.of.get(&place.file) {
                    place.file = module.file.display().to_string();
                }
            }
        }
    }
}

/// The name of a folder, which may be given as `.` or `..`.
fn folder_name(folder: &Path) -> Result<String, CommandError> {
    let folder = if folder.as_os_str().is_empty() {
        Path::new(".")
    } else {
        folder
    };
    let failed = |reason: String| CommandError::Module {
        path: folder.display().to_string(),
        reason,
    };
    let whole = folder
        .canonicalize()
        .map_err(|error| failed(error.to_string()))?;
    let name = whole
        .file_name()
        .map(|name| name.to_string_lossy().into_owned());
    name.ok_or_else(|| {
        failed("the folder has no name to import by; give one by `--module NAME=PATH`".to_owned())
    })
}
