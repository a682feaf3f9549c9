//! moment-shadows in Bevy 0.20: a plugin that filters Bevy's own shadow maps, and shafts of light.
//!
//! [`MomentShadowsPlugin`] takes any graph file whose import is `light_depth`: Bevy's layers of directional cascades and spot lights. An
//! output `shadow_map` of the graph is what materials look up that are extended by [`FilteredShadows`]; an output `scattering`, made with
//! the import `camera_depth`, is drawn over the picture. `docs/bevy.md` has it step by step, and what is not supported.

mod cameras;
mod compiled;
pub mod demo;
mod lights;
mod maps;
mod material;
mod node;
mod plugin;
mod shaders;
mod table;
mod warnings;

pub use material::FilteredShadows;
pub use moment_shadows_graph::LightSize;
pub use plugin::{Air, MomentShadows, MomentShadowsPlugin};

/// What the page about Bevy tells a reader to write compiles.
#[cfg(doctest)]
#[doc = include_str!("../../../../docs/bevy.md")]
mod page {}
