//! Why a cost was not reported.

use moment_shadows::{
    RectifiedFrameError, ScatteringViewError, SingleScatteringError, TechniqueError, TextureFormat,
};
use moment_shadows_graph::record::RecordError;
use moment_shadows_graph::{GraphError, ParameterError};

use crate::error::LabError;
use crate::gpu::GpuError;
use crate::picture::PictureError;
use crate::plot::PlotError;
use crate::summed_area::TableError;

/// Why a cost was not reported.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CostError {
    /// The lab could not prepare what is measured.
    #[error(transparent)]
    Lab(#[from] LabError),
    /// The device.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The library's recorder.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// A file that cannot be written.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// A plot.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// A summed-area table.
    #[error(transparent)]
    Table(#[from] TableError),
    /// An encoding that there is not.
    #[error(transparent)]
    Technique(#[from] TechniqueError),
    /// A graph that the harness makes itself.
    #[error(transparent)]
    Graph(#[from] GraphError),
    /// Parameters that a graph does not have.
    #[error(transparent)]
    Parameter(#[from] ParameterError),
    /// A camera and a light that are not for single scattering.
    #[error(transparent)]
    Scattering(#[from] ScatteringViewError),
    /// A camera and a light without rectified coordinates.
    #[error(transparent)]
    Frame(#[from] RectifiedFrameError),
    /// A medium that there is not.
    #[error(transparent)]
    Medium(#[from] SingleScatteringError),
    /// The work was submitted, but its end could not be waited for.
    #[error("the device did not finish '{what}': {reason}; it may have been lost")]
    Wait {
        /// The subject.
        what: String,
        /// What the driver said.
        reason: String,
    },
    /// A baseline that the device cannot run.
    #[error("a copy of {format} was refused: {reason}; measure a graph with another format")]
    Baseline {
        /// The format.
        format: TextureFormat,
        /// What the driver said.
        reason: String,
    },
    /// A format that the harness does not decode.
    #[error("{format} cannot be compared with the reference; only moments can")]
    Format {
        /// The format.
        format: TextureFormat,
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
}
