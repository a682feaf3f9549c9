//! Why a cost was not reported.

use moment_shadows::TextureFormat;
use moment_shadows_graph::GraphError;

use crate::error::LabError;

/// Why a cost was not reported.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CostError {
    /// What is measured could not be prepared or recorded, or its figures could not be saved.
    #[error(transparent)]
    Lab(LabError),
    /// A kernel or a graph that the harness makes itself.
    #[error(transparent)]
    Graph(#[from] GraphError),
    /// The work was submitted, but its end could not be waited for.
    #[error("the device did not finish '{what}': {reason}; it may have been lost")]
    Wait {
        /// The subject.
        what: String,
        /// What the driver said.
        reason: String,
    },
    /// Textures of a format that the device cannot copy by a shader, or that the harness does not decode.
    #[error("{format} cannot be measured: {reason}; measure a graph with another format")]
    Format {
        /// The format.
        format: TextureFormat,
        /// Why.
        reason: String,
    },
    /// A bandwidth on the command line that cannot be understood.
    #[error(
        "'{0}' is no bandwidth; give gigabytes per second above 0, and a name after a colon if you like: 224:GTX 970"
    )]
    Bandwidth(String),
    /// A pass that is fast and wrong.
    #[error(
        "{what} differs from the reference by {error:e}, more than {tolerance:e}; its cost means nothing"
    )]
    WrongResult {
        /// What was compared.
        what: String,
        /// The largest difference; NaN where the output is.
        error: f64,
        /// What rounding explains.
        tolerance: f64,
    },
}

impl<E: Into<LabError>> From<E> for CostError {
    fn from(error: E) -> Self {
        CostError::Lab(error.into())
    }
}
