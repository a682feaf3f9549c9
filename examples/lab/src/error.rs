//! Everything that a command can fail with.

use moment_shadows_graph::record::RecordError;
use moment_shadows_graph::{GraphError, ParameterError};

use crate::gpu::GpuError;
use crate::host::HostError;
use crate::light::LightError;
use crate::metric::MetricError;
use crate::picture::PictureError;
use crate::plot::PlotError;
use crate::scene::SceneError;
use crate::truth::area_light::AreaLightError;
use crate::truth::peel::PeelError;
use crate::truth::surface::TruthError;

/// Why the lab could not do what it was asked for. Each names its culprit.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LabError {
    /// The device.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The reference host.
    #[error(transparent)]
    Host(#[from] HostError),
    /// A light.
    #[error(transparent)]
    Light(#[from] LightError),
    /// A scene.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A file that cannot be read.
    #[error("{path} cannot be read: {reason}")]
    Read {
        /// The file.
        path: String,
        /// What the system said.
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
    /// A graph that is right, but that the lab cannot judge.
    #[error("{file}: {reason}")]
    Unsuitable {
        /// The graph file.
        file: String,
        /// Why.
        reason: String,
    },
    /// A technique's settings.
    #[error(transparent)]
    Technique(#[from] moment_shadows::TechniqueError),
    /// A plot.
    #[error(transparent)]
    Plot(#[from] PlotError),
    /// The library's parameters.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// A camera without an inverse.
    #[error(transparent)]
    Camera(#[from] moment_shadows::ViewError),
    /// A light's depth convention.
    #[error(transparent)]
    Depth(#[from] moment_shadows::DepthError),
    /// A light's size.
    #[error(transparent)]
    SoftLight(#[from] moment_shadows::AreaLightError),
    /// A camera or light whose scattering cannot be prefiltered.
    #[error(transparent)]
    ScatteringView(#[from] moment_shadows::ScatteringViewError),
    /// A medium that there is not.
    #[error(transparent)]
    SingleScattering(#[from] moment_shadows::SingleScatteringError),
    /// A kernel.
    #[error(transparent)]
    Kernel(#[from] moment_shadows::KernelError),
    /// The library's recorder.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// A truth.
    #[error(transparent)]
    Truth(#[from] TruthError),
    /// An area light.
    #[error(transparent)]
    AreaLight(#[from] AreaLightError),
    /// A scene that cannot be peeled.
    #[error(transparent)]
    Peel(#[from] PeelError),
    /// A shader of the lab that cannot be linked.
    #[error(transparent)]
    Link(#[from] moment_shadows::LinkError),
    /// A comparison.
    #[error(transparent)]
    Metric(#[from] MetricError),
    /// A picture.
    #[error(transparent)]
    Picture(#[from] PictureError),
}
