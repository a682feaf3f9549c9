//! Why there is no ISA table.

use std::path::Path;

use super::chip::Chip;
use crate::shaders::ShadersError;

/// Why shaders could not be compiled for a chip, or their table not be used.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum IsaError {
    /// No file tells where the driver is.
    #[error(
        "no Vulkan driver for AMD chips (radeon_icd) was found in {searched}; on Debian install it with `apt-get install \
         mesa-vulkan-drivers` (no GPU is needed)"
    )]
    NoDriver {
        /// The folders that were searched.
        searched: String,
    },
    /// The Vulkan loader is missing, or the driver refused something or left it out.
    #[error("{what}: {reason}")]
    Driver {
        /// What was asked for.
        what: &'static str,
        /// What was said instead, and what to do.
        reason: String,
    },
    /// The driver offers a device, but not the one asked for.
    #[error(
        "the driver gave '{found}' instead of {chip}; this version of it may not know the chip, or may only use the GPU \
         that is there"
    )]
    NoChip {
        /// What was asked for.
        chip: Chip,
        /// What the driver gave.
        found: String,
    },
    /// A shader of the catalogue cannot be made.
    #[error(transparent)]
    Catalogue(#[from] ShadersError),
    /// A shader does not fit the table, or its code could not be understood.
    #[error("shader '{shader}': {reason}")]
    Shader {
        /// The shader.
        shader: String,
        /// What is wrong.
        reason: String,
    },
    /// The process that compiles for a chip failed.
    #[error("compiling for {chip} failed: {reason}")]
    Child {
        /// The chip.
        chip: Chip,
        /// What it wrote, or how it ended.
        reason: String,
    },
    /// A file could not be read, used or written.
    #[error("{path}: {reason}")]
    File {
        /// The file.
        path: String,
        /// What is wrong, and what to do.
        reason: String,
    },
    /// There is no such shader.
    #[error("there is no shader '{name}'; the nearest are {nearest}")]
    UnknownShader {
        /// What was asked for.
        name: String,
        /// Shaders of similar names.
        nearest: String,
    },
}

impl IsaError {
    /// An error about a file.
    pub(crate) fn file(path: &Path, reason: impl ToString) -> Self {
        Self::File {
            path: path.display().to_string(),
            reason: reason.to_string(),
        }
    }

    /// What the driver does not tell.
    pub(super) fn incomplete(what: &'static str) -> Self {
        Self::Driver {
            what,
            reason: "the driver does not tell it; use Mesa's RADV from a distribution, in the version that the table names"
                .to_owned(),
        }
    }

    /// An error about a shader.
    pub(super) fn shader(shader: &str, reason: impl ToString) -> Self {
        Self::Shader {
            shader: shader.to_owned(),
            reason: reason.to_string(),
        }
    }
}
