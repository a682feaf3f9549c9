//! What several nodes share.
//!
//! | file | what it is |
//! |---|---|
//! | `specialization` | the generated modules of a node's shader, and the linking of all its modules |
//! | `fullscreen.wgsl` | the vertex stage of fullscreen passes |
//! | `depth_input`, `map_input` | inputs: formats, and what their texels mean |
//! | `regions` | passes over the regions of a map (`regions.wgsl`), computed (`write_computed.wgsl`) or drawn (`write_drawn.wgsl`) |
//! | `range_input` | the input `ranges`: depths of a map that are fitted to its casters (`range_of_*.wgsl`) |
//! | `lookup` | lookups in a filterable map, by a sampler or by loads (`moments_lookup_*.wgsl`) |
//! | `shading` | what `shade_hard` and `shade_soft` have in common (`shade_*.wgsl`, `views.wgsl`, `view_receiver.wgsl`) |
//! | `stored_targets` | the outputs of more lights than one has channels |
//! | `debug_view` | what they show of how they shade (`debug/*.wgsl`) |
//! | `tiled` | which of many views a pixel tries (`find_views.wgsl`, `view_list_*.wgsl`) |
//! | `mip_levels` | a property that several nodes have |
//! | `error` | what can be wrong |
//!
#![doc = include_str!("interfaces.md")]

pub(super) mod debug_view;
pub(super) mod depth_input;
mod error;
pub(super) mod lookup;
pub(super) mod map_input;
pub(super) mod mip_levels;
pub(super) mod range_input;
pub(super) mod regions;
pub(super) mod shading;
mod specialization;
mod stored_targets;
mod tiled;

pub(super) use error::{wrong_format, wrong_property, wrong_size};
pub(super) use specialization::Specialization;

/// A shader's file name and text.
macro_rules! wgsl {
    ($file:literal) => {
        ($file, include_str!($file))
    };
}
pub(super) use wgsl;
