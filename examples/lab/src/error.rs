//! Everything that a command can fail with.

use moment_shadows_graph::record::RecordError;
use moment_shadows_graph::{GraphError, ParameterError, RegionError};

use crate::gpu::GpuError;
use crate::host::HostError;
use crate::light::LightError;
use crate::metric::MetricError;
use crate::picture::PictureError;
use crate::scene::SceneError;
use crate::shaders::ShadersError;
use crate::truth::area_light::AreaLightError;
use crate::truth::peel::PeelError;
use crate::truth::surface::TruthError;
use crate::vectors::VectorFileError;

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
    /// Something that the lab cannot use: a graph that it cannot judge, a table of other figures, a driver that lacks something.
    #[error("{file}: {reason}")]
    Unsuitable {
        /// The graph file, or what else it is.
        file: String,
        /// Why, and what to do.
        reason: String,
    },
    /// Shaders that cannot be listed or compiled.
    #[error(transparent)]
    Shaders(#[from] ShadersError),
    /// A plot that cannot be drawn.
    #[error("the plot '{title}' cannot be drawn: {reason}")]
    Plot {
        /// Its title.
        title: String,
        /// Why.
        reason: String,
    },
    /// A technique is asked for in a storage that it has not.
    #[error("'{technique}' is not stored as {storage}; it is as {legal}")]
    NoPair {
        /// The technique's name.
        technique: String,
        /// The storage's name.
        storage: String,
        /// The storages that it has.
        legal: String,
    },
    /// A file of vectors.
    #[error(transparent)]
    Vectors(#[from] VectorFileError),
    /// The shader of a batch was refused.
    #[error("the shader of batch '{label}' was refused: {reason}")]
    Shader {
        /// The batch's label.
        label: String,
        /// What the validation said.
        reason: String,
    },
    /// The Rust types cannot be those of a batch's shader.
    #[error(
        "batch '{label}' has items of {input} and {output} bytes; arrays in storage buffers need positive multiples of 4 \
         that fit into {largest} bytes"
    )]
    ItemSize {
        /// The batch's label.
        label: String,
        /// Bytes of an input item.
        input: usize,
        /// Bytes of an output item.
        output: usize,
        /// The largest buffer that the device binds.
        largest: u64,
    },
    /// Figures as JSON.
    #[error("the figures cannot be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// The regions of a map.
    #[error(transparent)]
    Region(#[from] RegionError),
    /// The library's parameters.
    #[error(transparent)]
    Parameters(#[from] ParameterError),
    /// A value that the library refuses.
    #[error(transparent)]
    Value(#[from] moment_shadows::ValueError),
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
    Link(#[from] moment_shadows::ShaderError),
    /// A comparison.
    #[error(transparent)]
    Metric(#[from] MetricError),
    /// A picture.
    #[error(transparent)]
    Picture(#[from] PictureError),
}

impl LabError {
    /// What cannot be used, and why.
    pub fn unsuitable(what: impl ToString, reason: impl ToString) -> Self {
        Self::Unsuitable {
            file: what.to_string(),
            reason: reason.to_string(),
        }
    }
}
