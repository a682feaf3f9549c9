//! The subcommands of `moment-shadows`.

pub mod bias;
pub mod contacts;
pub mod cost;
pub mod error;
pub mod error_table;
pub mod graph;
pub mod isa;
pub mod measure;
pub mod minification;
pub mod render;
pub mod scattering_error;
pub mod scattering_flicker;
pub mod shaders;
pub mod soft_error;
pub mod stability;
pub mod technique_pictures;
pub mod validate;
