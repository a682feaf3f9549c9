//! Why shaders cannot be listed, compiled or written.

use std::path::PathBuf;

use moment_shadows::{ShaderError, ValueError};
use moment_shadows_graph::GraphError;

/// Why shaders cannot be listed, compiled or written. Nothing is left behind.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ShadersError {
    /// A node refuses one of the variants it is listed with.
    #[error("the variant '{name}' of a node cannot be described: {error}; correct the catalogue")]
    Node {
        /// The variant.
        name: String,
        /// What the node says.
        error: Box<GraphError>,
    },
    /// A map or a table of the catalogue cannot be.
    #[error(transparent)]
    Value(#[from] ValueError),
    /// A shader does not link.
    #[error(transparent)]
    Link(#[from] ShaderError),
    /// naga refuses a shader.
    #[error("shader '{name}' does not compile: {reason}")]
    Compile {
        /// The shader.
        name: String,
        /// What naga says.
        reason: String,
    },
    /// There is something in the way of the folder.
    #[error("'{}' exists and is not an empty folder; remove it or name another one", .0.display())]
    Exists(PathBuf),
    /// A file cannot be written.
    #[error("the shaders cannot be written to '{}': {source}; nothing is left there", folder.display())]
    Write {
        /// The folder to be written.
        folder: PathBuf,
        /// What the system says.
        source: std::io::Error,
    },
}
