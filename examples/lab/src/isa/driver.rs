//! The driver's files: where it is, and what exactly it is.

use std::path::PathBuf;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::error::LabError;

/// A driver.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Driver {
    /// The name, as it tells it.
    pub name: String,
    /// The version, as it tells it.
    pub version: String,
    /// SHA-256 of the library, in hexadecimal digits.
    pub sha256: String,
}

/// Where distributions put the files that name drivers.
const FOLDERS: [&str; 3] = [
    "/usr/share/vulkan/icd.d",
    "/usr/local/share/vulkan/icd.d",
    "/etc/vulkan/icd.d",
];

/// The library's file name begins with this.
const LIBRARY: &str = "libvulkan_radeon";

/// The file that names the driver for AMD chips: that of this machine's architecture before others.
pub(super) fn manifest() -> Result<PathBuf, LabError> {
    let mut found: Vec<PathBuf> = FOLDERS
        .iter()
        .filter_map(|folder| std::fs::read_dir(folder).ok())
        .flat_map(|files| files.filter_map(|file| file.ok().map(|file| file.path())))
        .filter(|path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            name.starts_with("radeon_icd") && name.ends_with(".json")
        })
        .collect();
    found.sort_by_key(|path| {
        let other = !path.to_string_lossy().contains(std::env::consts::ARCH);
        (other, path.clone())
    });
    found.into_iter().next().ok_or_else(|| {
        LabError::unsuitable(
            "no Vulkan driver for AMD chips (radeon_icd)",
            format!(
                "none was found in {}; on Debian install it with `apt-get install mesa-vulkan-drivers` (no GPU is needed)",
                FOLDERS.join(", ")
            ),
        )
    })
}

/// SHA-256 of the driver that this process has loaded.
pub(super) fn loaded_sha256() -> Result<String, LabError> {
    let maps = "/proc/self/maps";
    let text = std::fs::read_to_string(maps).map_err(|error| LabError::unsuitable(maps, error))?;
    let library = library_in(&text).ok_or_else(|| incomplete("which library the driver is"))?;
    let bytes = std::fs::read(library).map_err(|error| LabError::unsuitable(library, error))?;
    let digest = Sha256::digest(&bytes);
    Ok(digest.iter().map(|byte| format!("{byte:02x}")).collect())
}

/// What the driver does not tell.
pub(super) fn incomplete(what: &str) -> LabError {
    let reason = "the driver does not tell it; use Mesa's RADV from a distribution, in the version that the table names";
    LabError::unsuitable(what, reason)
}

/// The driver's path in a list of memory maps, whose lines end with the file that is mapped.
fn library_in(maps: &str) -> Option<&str> {
    maps.lines()
        .filter_map(|line| line.find('/').map(|start| &line[start..]))
        .find(|path| {
            let name = path.rsplit('/').next().unwrap_or_default();
            name.starts_with(LIBRARY)
        })
}

#[cfg(test)]
mod tests {
    use super::library_in;

    #[test]
    fn the_driver_is_found_among_memory_maps() {
        let maps = "7f00-7f01 r--p 00000000 08:01 1   /usr/lib/libc.so.6\n\
                    7f02-7f03 rw-p 00000000 00:00 0\n\
                    7f04-7f05 r-xp 00000000 08:01 2   /usr/lib/x86 64/libvulkan_radeon.so\n";
        assert_eq!(
            library_in(maps),
            Some("/usr/lib/x86 64/libvulkan_radeon.so")
        );
        assert_eq!(
            library_in("7f00-7f01 r--p 0 0 0 /usr/lib/libvulkan_lvp.so"),
            None
        );
    }
}
