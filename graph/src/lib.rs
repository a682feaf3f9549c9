//! Declarative render-graph nodes for filterable shadows, their graph file and compiler, and a wgpu recorder.
//!
//! ```text
//! Graph::parse ─▶ compile ─▶ Plan ─▶ record::Pipelines ─▶ record::Resources ─▶ record::Bindings ─▶ record
//!   (a file)      (checks)   (data)   (once per shader)     (once per size)     (once per import)   (every frame)
//! ```
//!
//! A node describes itself as plain data ([`NodeDesc`]); the compiler checks a graph of nodes against the host's imports
//! and the device's [`Capabilities`] and gives a [`Plan`], which any engine can record. The `record` module (feature
//! `wgpu`) records it with wgpu.

// A technique, a storage or a format is never taken for another one.
#![warn(clippy::wildcard_enum_match_arm)]

mod capabilities;
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
#[cfg(feature = "wgpu")]
mod session;
mod version_1;

/// How a host writes a node of its own.
#[cfg(any(doc, doctest))]
#[doc = include_str!("../docs/write_a_node.md")]
pub mod write_a_node {}

pub use capabilities::Capabilities;
pub use compile::{Imports, compile, describe};
pub use error::{GraphError, GraphErrorKind, Position};
pub use graph::{Edge, Endpoint, Graph, GraphNode, Import, Output, VERSION};
pub use node::{
    Binding, BindingResource, Connected, CountRule, Direction, ExtentRule, FormatRule, Lifetime,
    MipLevel, Node, NodeDesc, ParameterBlock, Pass, RegionTable, SameAs, Slot, SlotResource, Stage,
    TextureRule, Work, bind, same_as,
};
pub use plan::{
    Home, NamedResource, ParameterError, ParameterLayout, Plan, PlanError, PlannedBinding,
    PlannedBindingResource, PlannedMemory, PlannedParameters, PlannedPass, PlannedRegions,
    PlannedResource, PlannedWork, RegionError, SampleType,
};
pub use registry::NodeRegistry;
pub use resource::{Access, ResourceDesc, TextureDesc};
#[cfg(feature = "wgpu")]
pub use session::{Session, SessionError};

/// What a [`Session`] is told, from the core crate.
pub use moment_shadows::{
    CameraView, DepthRange, LightDepth, LightSize, LightView, MapRegion, SingleScattering,
};
pub use version_1::upgrade;
