//! The subcommands of `moment-shadows`.

pub mod graph;
pub mod measure;
pub mod render;
pub mod validate;
