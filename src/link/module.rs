//! The registry: the WGSL modules of the library, as text that is part of the crate.

use std::env;
use std::fs;
use std::path::PathBuf;
use std::sync::LazyLock;

use crate::{Rule, ShaderError};

/// One importable WGSL module: `wgsl/<folder>/<name>.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Module {
    /// The folder, which says the stage of the work: the name after `moment_shadows::` in an import.
    pub folder: &'static str,
    /// The name after the folder.
    pub name: &'static str,
    /// The text of the module, imports included.
    pub source: &'static str,
}

// `MODULES`, and `ITEMS`: the path and the name of what each of them defines.
include!(concat!(env!("OUT_DIR"), "/modules.rs"));

/// The environment variable that names a folder of edited modules.
const EDITED: &str = "MOMENT_SHADOWS_WGSL";

/// Every WGSL module of the library, by folder and name.
///
/// Work on a module needs no new build: in debug builds the environment variable `MOMENT_SHADOWS_WGSL` may name a folder like
/// `wgsl/`, whose files are read when the modules are first used. A file that is missing there, or cannot be read, keeps the
/// text that is part of the crate; a new file does not become a module. Release builds ignore the variable.
#[must_use]
pub fn modules() -> &'static [Module] {
    static IN_USE: LazyLock<Vec<Module>> = LazyLock::new(|| {
        let folder = edited_folder();
        let edited = |module: &Module| {
            let path = folder.as_ref()?.join(module.folder).join(module.name);
            let text = fs::read_to_string(path.with_extension("wgsl")).ok()?;
            let source = text.leak();
            Some(Module { source, ..*module })
        };
        let texts = MODULES.iter().map(|it| edited(it).unwrap_or(*it));
        texts.collect()
    });
    &IN_USE
}

fn edited_folder() -> Option<PathBuf> {
    let set = cfg!(debug_assertions).then(|| env::var_os(EDITED));
    set.flatten().map(PathBuf::from)
}

/// Refuses a variable that names no folder: every module would silently keep its text.
pub(super) fn check_edited_folder() -> Result<(), ShaderError> {
    match edited_folder() {
        Some(folder) if !folder.is_dir() => {
            let folder = folder.display();
            let message = format!(
                "the environment variable {EDITED} names {folder}, which is no folder; name one, or unset it"
            );
            Err(ShaderError::new(Rule::Import, message))
        }
        _ => Ok(()),
    }
}
