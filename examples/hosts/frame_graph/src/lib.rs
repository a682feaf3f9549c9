//! Plans of moment-shadows in a frame graph that is not ours: nightshade-renderer's, on a wgpu of another version.

pub mod adapter;
pub mod device;
pub mod error;
pub mod frame;
pub mod gpu;
pub mod graphs;
pub mod variants;
pub mod world;
