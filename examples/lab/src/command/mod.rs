//! The subcommands of `moment-shadows`.

pub mod cost;
pub mod cost_growth;
pub mod error;
pub mod error_table;
pub mod graph;
pub mod isa;
pub mod measure;
pub mod minification;
pub mod render;
pub mod shaders;
pub mod stability;
pub mod validate;
