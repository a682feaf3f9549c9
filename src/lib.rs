//! Filterable shadow maps for any wgpu or WebGPU renderer.

mod profile;

pub use profile::Profile;
