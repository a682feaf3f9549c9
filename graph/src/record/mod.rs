//! Recording a plan with wgpu.
//!
//! Nothing here creates a device, submits, maps or waits. Objects are created once ([`Pipelines`] per shader,
//! [`Resources`] per size, [`Bindings`] per set of imports); [`Bindings::record`] then only records. Creation is async
//! because it waits for the device's verdict: what fails to be created is an error, not a panic or a callback.

mod at_once;
mod bindings;
mod blend;
mod format;
mod given;
mod layout;
mod objects;
mod pipelines;
mod recording;
mod resources;
mod samplers;
mod scope;

pub use bindings::Bindings;
pub use blend::blend_state;
pub use given::ImportedResource;
pub use pipelines::{HostTarget, PipelineOptions, Pipelines};
pub(crate) use recording::HostPassHandler;
pub use recording::{HostPass, Layers, Recording};
pub use resources::Resources;
pub(crate) use scope::{scoped, written};
