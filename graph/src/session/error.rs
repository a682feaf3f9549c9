//! Why a session cannot do what it is asked to.

use crate::record::RecordError;
use crate::{GraphError, ParameterError, RegionError};

/// Why a session cannot do what it is asked to. It is then as it was before.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SessionError {
    /// The graph does not fit the device or the textures.
    #[error(transparent)]
    Graph(#[from] GraphError),
    /// The device refused, or a texture lacks a usage.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// More views of lights than the graph's nodes take.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// A region that the map cannot have.
    #[error(transparent)]
    Regions(#[from] RegionError),
    /// A texture, a camera, a light or the medium cannot be used.
    #[error("{what}: {reason}")]
    Unsuitable {
        /// What cannot be used.
        what: String,
        /// What is wrong with it, and what would be right.
        reason: String,
    },
}

impl SessionError {
    pub(super) fn unsuitable(what: impl Into<String>, reason: impl ToString) -> Self {
        Self::Unsuitable {
            what: what.into(),
            reason: reason.to_string(),
        }
    }
}
