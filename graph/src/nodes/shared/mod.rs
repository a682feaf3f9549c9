//! What several nodes share.
//!
//! | file | what it is |
//! |---|---|
//! | `specialization` | the generated module of a node's shader, and the linking of all its modules |
//! | `fullscreen.wgsl` | the vertex stage of fullscreen passes |
//! | `map_input` | the input `map`: the formats of filterable maps, and what their texels mean |
//! | `regions` | passes over the regions of a map, computed (`region_tile.wgsl`) or drawn (`region_pixel.wgsl`) |
//! | `lookup` | lookups in a filterable map, by a sampler or by loads (`moments_lookup_*.wgsl`) |
//! | `shading` | what `shade_hard` and `shade_soft` have in common (`shade.wgsl`) |
//! | `kernel_property`, `mip_levels` | properties that several nodes have |
//!
#![doc = include_str!("interfaces.md")]

mod kernel_property;
pub(super) mod lookup;
pub(super) mod map_input;
mod mip_levels;
pub(super) mod regions;
pub(super) mod shading;
mod specialization;

pub use kernel_property::KernelProperty;
pub use mip_levels::MipLevels;
use moment_shadows::TextureFormat;
pub(super) use specialization::Specialization;

pub(super) use super::techniques::VirtualModule;
use serde::{Deserialize, Serialize};

use crate::{Rule, TextureDesc, TextureRule};

/// The virtual module with the vertex stage of fullscreen passes.
pub(super) const FULLSCREEN: VirtualModule = ("fullscreen", include_str!("fullscreen.wgsl"));

/// A shader's file name and text.
macro_rules! wgsl {
    ($file:literal) => {
        ($file, include_str!($file))
    };
}
pub(super) use wgsl;

/// A depth map: one layer, one sample.
pub(super) fn depth() -> TextureRule {
    TextureRule::new(DEPTHS.as_slice())
}

/// The formats of depth maps.
pub(super) const DEPTHS: [TextureFormat; 2] =
    [TextureFormat::Depth32Float, TextureFormat::Depth16Unorm];

/// A light's depth map: any number of layers, one sample or several.
pub(super) fn light_depth() -> TextureRule {
    depth()
        .layers(Rule::Any)
        .mips(Rule::Any)
        .samples([1, 2, 4, 8].as_slice())
}

/// The WGSL type of one layer of it.
pub(super) fn depth_texture(depth: &TextureDesc) -> &'static str {
    if depth.samples > 1 {
        "texture_depth_multisampled_2d"
    } else {
        "texture_depth_2d"
    }
}

/// A node without properties.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct NoProperties {}

macro_rules! without_properties {
    ($($node:ident),+) => {
        $(
            impl From<NoProperties> for super::$node {
                fn from(_: NoProperties) -> Self {
                    Self
                }
            }

            impl From<super::$node> for NoProperties {
                fn from(_: super::$node) -> Self {
                    Self {}
                }
            }
        )+
    };
}

without_properties!(Downsample, IntegrateScattering);
