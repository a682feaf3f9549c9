//! Everything that a command can fail with.

use moment_shadows_graph::GraphError;
use moment_shadows_graph::command::CommandError;

/// Why the lab could not do what it was asked for. Each names its culprit.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LabError {
    /// What the lab itself refuses, or what a device or a file refuses it: what, why, and what to do.
    #[error("{0}")]
    Refused(String),
    /// What the library's own command fails with, too: a graph file, or an adapter.
    #[error(transparent)]
    Command(#[from] CommandError),
    /// Something that the lab cannot use: a graph that it cannot judge, a table of other figures, a driver that lacks something.
    #[error("{file}: {reason}")]
    Unsuitable {
        /// The graph file, or what else it is.
        file: String,
        /// Why, and what to do.
        reason: String,
    },
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
    /// Figures as JSON.
    #[error("the figures cannot be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// A value that the library refuses.
    #[error(transparent)]
    Value(#[from] moment_shadows::ValueError),
    /// A plan that is not recorded, or parameters that do not fit it.
    #[error(transparent)]
    Record(#[from] GraphError),
    /// A shader of the lab that cannot be linked.
    #[error(transparent)]
    Link(#[from] moment_shadows::ShaderError),
}

impl LabError {
    /// What is refused, why, and what to do, as a sentence.
    pub fn refused(reason: impl Into<String>) -> Self {
        Self::Refused(reason.into())
    }

    /// What is wrong with the graph of a file.
    pub fn graph(file: &str) -> impl FnOnce(GraphError) -> Self {
        let of_file = CommandError::graph(file);
        move |error| of_file(error).into()
    }

    /// What cannot be used, and why.
    pub fn unsuitable(what: impl ToString, reason: impl ToString) -> Self {
        Self::Unsuitable {
            file: what.to_string(),
            reason: reason.to_string(),
        }
    }
}
