//! Everything that a sub-command can fail with.

use std::io;

use moment_shadows::ValueError;

use crate::GraphError;

/// Why a sub-command could not do what it was asked for. Each names its culprit.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CommandError {
    /// A file that cannot be read.
    #[error("'{path}' cannot be read: {source}")]
    Read {
        /// The file.
        path: String,
        /// What the system says.
        source: io::Error,
    },
    /// A file that cannot be written.
    #[error("'{path}' cannot be written: {reason}")]
    Write {
        /// The file.
        path: String,
        /// Why, and what to do.
        reason: String,
    },
    /// The output cannot be written.
    #[error("the output cannot be written: {0}")]
    Output(#[source] io::Error),
    /// A module of a project's own that has no name of its own.
    #[error("'{path}' cannot be a module: {reason}")]
    Module {
        /// The file or folder.
        path: String,
        /// Why, and what to do.
        reason: String,
    },
    /// A graph file.
    #[error("{file}:{error}")]
    Graph {
        /// The file.
        file: String,
        /// What is wrong with it.
        error: GraphError,
    },
    /// A plan as JSON.
    #[error("the plan cannot be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// A technique, a setting or a storage that cannot be exported.
    #[error("{0}")]
    Value(#[from] ValueError),
    /// A technique of which no functions without bindings can be made.
    #[error(
        "'{0}' reads the plain depth map, through textures and samplers that a file of functions does not have; export a technique \
         that has a map of its own, as hamburger4"
    )]
    ReadsDepth(&'static str),
    /// No adapter runs graphs here.
    #[error(
        "no graphics adapter was found for Vulkan, Metal or Direct3D 12; on Debian install a software driver with \
         `apt-get install mesa-vulkan-drivers`, elsewhere install a Vulkan, Metal or Direct3D 12 driver"
    )]
    NoAdapter,
    /// An adapter that gives no device.
    #[error("adapter '{adapter}' gave no device: {reason}")]
    NoDevice {
        /// The adapter.
        adapter: String,
        /// What wgpu says.
        reason: String,
    },
    /// A sub-command that needs wgpu, in a command that was built without it.
    #[error(
        "this command was built without wgpu; `cargo install moment-shadows-graph --features cli` builds it with wgpu"
    )]
    WithoutWgpu,
}

impl CommandError {
    /// What is wrong with the graph of a file.
    pub fn graph(file: &str) -> impl FnOnce(GraphError) -> Self {
        let file = file.to_owned();
        move |error| Self::Graph { file, error }
    }

    /// Whether it is only that nobody reads the output to its end.
    #[must_use]
    pub fn is_not_read(&self) -> bool {
        matches!(self, Self::Output(error) if error.kind() == io::ErrorKind::BrokenPipe)
    }
}
