//! The registry: the WGSL modules of the library, as text that is part of the crate.

use std::collections::BTreeSet;
use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

use crate::LinkError;

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

macro_rules! modules {
    ($($folder:literal: [$($name:literal),* $(,)?]),* $(,)?) => {
        &[$($(Module {
            folder: $folder,
            name: $name,
            source: include_str!(concat!("../../wgsl/", $folder, "/", $name, ".wgsl")),
        }),*),*]
    };
}

const MODULES: &[Module] = modules![
    "maths": ["angle", "disk_samples", "hankel", "split_sum", "two_diracs"],
    "map": ["depth", "map_load", "map_lookup", "map_region", "minification", "storage"],
    "moments": ["enclosed_moments", "four_moments", "six_moments", "two_moments"],
    "bounds": ["chebyshev", "hamburger4", "hamburger6", "hausdorff4"],
    "techniques": ["convolution", "exponential", "exponential_variance", "layered_variance", "lloyd", "percentage_closer", "percentage_closer_hardware", "percentage_closer_soft"],
    "filter": ["gaussian", "prefix_sum", "separable", "summed_area_encoding", "summed_area_table"],
    "shade": ["area_light", "leak_reduction", "moment_soft_shadows", "receiver_bias", "receiver_plane", "soft_blockers"],
    "air": ["phase_function", "rectified_frame", "scattering_weights", "single_scattering"],
];

/// The environment variable that names a folder of edited modules.
const EDITED: &str = "MOMENT_SHADOWS_WGSL";

/// Every WGSL module of the library, folder by folder in the order of the work, by name within each.
///
/// Work on a module needs no new build: in debug builds the environment variable `MOMENT_SHADOWS_WGSL` may name a folder like
/// `wgsl/`, whose files are read at each call, and each time something is linked. A file that is missing there, or cannot be
/// read, keeps the text that is part of the crate; a new file does not become a module. Release builds ignore the variable.
#[must_use]
pub fn modules() -> &'static [Module] {
    edited_folder().map_or(MODULES, |folder| edited(&folder))
}

fn edited_folder() -> Option<PathBuf> {
    let set = cfg!(debug_assertions).then(|| env::var_os(EDITED));
    set.flatten().map(PathBuf::from)
}

/// Refuses a variable that names no folder: every module would silently keep its text.
pub(super) fn check_edited_folder() -> Result<(), LinkError> {
    match edited_folder() {
        Some(folder) if !folder.is_dir() => Err(LinkError::NoFolder {
            variable: EDITED,
            folder,
        }),
        _ => Ok(()),
    }
}

/// The modules with the texts that `folder` has. Each text that was ever read stays in memory, once.
fn edited(folder: &Path) -> &'static [Module] {
    static TEXTS: Mutex<BTreeSet<&str>> = Mutex::new(BTreeSet::new());
    static LISTS: Mutex<Vec<&[Module]>> = Mutex::new(Vec::new());
    let mut texts = TEXTS.lock().unwrap_or_else(PoisonError::into_inner);
    let mut read = |module: &Module| {
        let path = folder.join(module.folder).join(module.name);
        let Ok(bytes) = fs::read(path.with_extension("wgsl")) else {
            return *module;
        };
        let text = String::from_utf8_lossy(&bytes).into_owned();
        let source = texts.get(text.as_str()).copied().unwrap_or_else(|| {
            let text: &'static str = text.leak();
            texts.insert(text);
            text
        });
        Module { source, ..*module }
    };
    let list: Vec<_> = MODULES.iter().map(&mut read).collect();
    let mut lists = LISTS.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(known) = lists.iter().find(|known| **known == list.as_slice()) {
        return known;
    }
    lists.push(list.leak());
    lists.last().copied().unwrap_or(MODULES)
}
