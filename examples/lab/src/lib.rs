//! The instrument of moment-shadows: a small reference host, ground truths, an oracle and a cost harness.
//!
//! Not published. It renders real geometry with the library's nodes, and judges what they give.

pub mod basis;
pub mod batch;
pub mod bias;
pub mod candidate;
pub mod catalogue;
pub mod cli;
pub mod command;
pub mod compare;
pub mod contacts;
pub mod cost;
pub mod dense;
pub mod error;
pub mod frame;
pub mod gpu;
pub mod graph_file;
pub mod graph_frame;
pub mod host;
pub mod isa;
pub mod judgement;
pub mod light;
pub mod metric;
mod node_on_map;
pub mod oracle;
mod pass;
pub mod penumbra;
pub mod picture;
pub mod plot;
pub mod ports;
pub mod progress;
pub mod scattering;
pub mod scene;
pub mod shaders;
pub mod soft;
pub mod stability;
pub mod summed_area;
pub mod surface_error;
pub mod sweep;
pub mod techniques;
mod texture;
pub mod trade;
pub mod troubleshooting;
pub mod truth;
pub mod vectors;
pub mod view;
mod wgsl_number;
