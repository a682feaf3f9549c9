//! The instrument of moment-shadows: a small reference host, ground truths, an oracle and a cost harness.
//!
//! Not published. It renders real geometry with the library's nodes, and judges what they give.

pub mod batch;
pub mod gpu;
pub mod host;
pub mod light;
pub mod metric;
pub mod oracle;
pub mod picture;
pub mod progress;
pub mod scene;
pub mod truth;
pub mod validate_command;
pub mod vectors;
pub mod view;
