//! A plan's data as objects of a wgpu device: what any host on wgpu makes and records.

mod layout;
mod memory;
mod names;
mod pipelines;
mod recorder;

pub use memory::{buffer, fill, texture_usage};
pub use names::by_name;
pub use pipelines::Pipelines;
pub use recorder::{Object, Objects, Recorder};
