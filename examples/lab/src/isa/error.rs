//! Why there is no ISA table.

use moment_shadows_graph::GraphError;

use super::chip::Chip;

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
    /// The Vulkan loader is missing.
    #[error(
        "the Vulkan loader cannot be loaded: {reason}; on Debian install it with `apt-get install libvulkan1`"
    )]
    Loader {
        /// What the system said.
        reason: String,
    },
    /// The driver has no device.
    #[error(
        "the driver offers no device, not even one without a GPU; use Mesa's RADV built with LLVM or its own compiler"
    )]
    NoDevice,
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
    /// The driver refused to make something.
    #[error("the driver did not give {what}: {reason}; try the version of it that the table names")]
    Driver {
        /// What it was to make.
        what: &'static str,
        /// What it said.
        reason: String,
    },
    /// The driver left something out.
    #[error("the driver does not tell {what}; use Mesa's RADV from a distribution")]
    Incomplete {
        /// What is missing.
        what: &'static str,
    },
    /// The driver does not tell a statistic.
    #[error(
        "shader '{shader}': the driver does not tell '{statistic}'; use the version of it that the table names"
    )]
    Statistic {
        /// The shader.
        shader: String,
        /// The statistic's name.
        statistic: &'static str,
    },
    /// A shader is not valid.
    #[error("shader '{shader}': {reason}")]
    Shader {
        /// The shader.
        shader: String,
        /// What is wrong.
        reason: String,
    },
    /// A node could not describe itself.
    #[error("shader '{shader}': {error}")]
    Node {
        /// The shader.
        shader: String,
        /// What the node said.
        error: GraphError,
    },
    /// The number of loops differs from what the list says.
    #[error(
        "shader '{shader}' on {chip}: its code has {found} loops where the list of shaders gives trip counts for {listed}; \
         correct the trip counts in the list"
    )]
    Loops {
        /// The shader.
        shader: String,
        /// The chip.
        chip: Chip,
        /// Loops in the code.
        found: usize,
        /// Trip counts in the list.
        listed: usize,
    },
    /// The driver's disassembly could not be understood.
    #[error("shader '{shader}' on {chip}: {reason}")]
    Text {
        /// The shader.
        shader: String,
        /// The chip.
        chip: Chip,
        /// What is odd.
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
    /// A file could not be read or written.
    #[error("{path}: {reason}")]
    File {
        /// The file.
        path: String,
        /// What is wrong, and what to do.
        reason: String,
    },
    /// The table was made by another version of the driver.
    #[error(
        "{path} belongs to {table}, but this is {now}, whose figures cannot be compared with it; install that driver, or \
         make a table for this one with `isa --update`"
    )]
    OtherDriver {
        /// The table.
        path: String,
        /// The driver that made it.
        table: String,
        /// The driver here.
        now: String,
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
