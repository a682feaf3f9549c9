//! What can be wrong.

use std::path::PathBuf;

use moment_shadows_graph::GraphError;

#[derive(Debug, thiserror::Error)]
pub(crate) enum RecorderError {
    #[error("give the folder that moment-shadows-frame-graph wrote")]
    NoFolder,
    #[error("{path}: {source}; let moment-shadows-frame-graph write the folder first")]
    File {
        path: PathBuf,
        source: std::io::Error,
    },
    #[error("{path} is no plan of this library: {source}; write the folder again")]
    Plan {
        path: PathBuf,
        source: serde_json::Error,
    },
    #[error("{0}: no texture is compared in this format or of this size; draw another graph")]
    Format(String),
    #[error("{0}")]
    Device(String),
    #[error(transparent)]
    Graph(#[from] GraphError),
}
