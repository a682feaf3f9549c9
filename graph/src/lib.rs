//! Declarative render-graph nodes for filterable shadows, their graph file and compiler, and a wgpu recorder.
//!
//! ```text
//! Graph::parse ─▶ compile ─▶ Plan ─▶ record::Pipelines ─▶ record::Resources ─▶ record::Bindings ─▶ record
//!   (a file)      (checks)   (data)   (once per shader)     (once per size)     (once per import)   (every frame)
//! ```
//!
//! Begin with [`Session`], the short path: a graph file, a device and an engine's own depth textures in, shadow intensity out.
//! [The examples](https://github.com/moment-shadows/moment-shadows/tree/main/examples) are short programs to copy from; what may stand in
//! a graph file is on [one page](https://github.com/moment-shadows/moment-shadows/blob/main/docs/graph_file.md), what
//! [the shadow pass](https://github.com/moment-shadows/moment-shadows/blob/main/docs/shadow_pass.md) has to do on another, and
//! [what mistakes look like](https://github.com/moment-shadows/moment-shadows/blob/main/docs/troubleshooting.md) on a third.
//!
//! Shaders of your own import [the same modules](https://github.com/moment-shadows/moment-shadows/blob/main/docs/wgsl.md).
//!
//! A node describes itself as plain data ([`NodeDesc`]); the compiler checks a graph of nodes against the host's imports
//! and the device's [`Capabilities`] and gives a [`Plan`], which any engine can record. The `record` module (feature
//! `wgpu`) records it with wgpu.

// A technique, a storage or a format is never taken for another one.
#![warn(clippy::wildcard_enum_match_arm)]

mod capabilities;
#[cfg(feature = "cli")]
pub mod command;
mod compile;
mod error;
mod graph;
mod node;
pub mod nodes;
mod plan;
#[cfg(feature = "wgpu")]
pub mod record;
mod registry;
mod resource;
#[cfg(feature = "schema")]
mod schema;
#[cfg(feature = "wgpu")]
mod session;
mod version_1;

/// How a host writes a node of its own.
#[cfg(any(doc, doctest))]
#[doc = include_str!("../docs/write_a_node.md")]
pub mod write_a_node {}

pub use capabilities::Capabilities;
pub use error::{GraphError, GraphErrorKind, Position};
pub use graph::{Edge, Graph, Named};
pub use node::{
    Binding, BindingResource, Connected, Direction, Node, NodeDesc, Off, ParameterBlock, Pass,
    Rule, Slot, SlotResource, Stage, TextureRule, Work, bind,
};
pub use plan::{
    AddressMode, BindingLayout, BufferKind, CompareFunction, FilterMode, Home, Instead, Lives,
    ParameterLayout, Plan, PlannedBinding, PlannedBindingResource, PlannedDevice, PlannedExtent,
    PlannedField, PlannedMemory, PlannedOff, PlannedOffset, PlannedParameters, PlannedPart,
    PlannedPass, PlannedRegions, PlannedResource, PlannedSampler, PlannedUse, PlannedWork,
    SampleType, SamplerKind, StorageAccess, Usage, ViewDimension, Visibility,
};
pub use registry::NodeRegistry;
pub use resource::{Access, ResourceDesc, TextureDesc};
#[cfg(feature = "wgpu")]
pub use session::Session;

/// What a [`Session`] is told, from the core crate.
pub use moment_shadows::{
    Border, CameraView, DepthRange, HeightFog, LightDepth, LightSize, LightView, MarchedAir,
    SingleScattering, SpotCone,
};
