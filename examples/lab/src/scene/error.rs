//! What can be wrong with a scene.

use std::path::PathBuf;

/// Why a scene could not be loaded.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// Neither a file nor a scene of our own has this name.
    #[error("there is no file '{name}', nor a procedural scene of that name; {advice}")]
    Unknown {
        /// What was asked for.
        name: String,
        /// The names that exist.
        advice: String,
    },
    /// The file could not be read, is malformed, or is more than this host is made for.
    #[error("'{}' cannot be shown: {reason}", file.display())]
    File {
        /// The file.
        file: PathBuf,
        /// What is wrong with which item in it.
        reason: String,
    },
}
