//! Filterable shadow maps for any wgpu or WebGPU renderer.
//!
//! The product is WGSL: [`modules()`] that hold functions, structs and constants only, no bindings and no entry points.
//! A shader names what it uses, and [`link()`] makes one plain WGSL text of it:
//!
//! ```
//! use moment_shadows::{Source, link};
//!
//! let shader = Source {
//!     name: "lit.wgsl",
//!     text: "
//! import moment_shadows::bounds::hamburger4::{hamburger4_shadow_intensity};
//! import moment_shadows::moments::four_moments::{FOUR_MOMENTS_BIAS_FLOAT16};
//!
//! fn shadow(moments: vec4f, fragment_depth: f32) -> f32 {
//!     return hamburger4_shadow_intensity(moments, fragment_depth, FOUR_MOMENTS_BIAS_FLOAT16);
//! }
//! ",
//! };
//! let linked = link(shader, &[])?;
//! assert!(linked.wgsl().contains("fn hankel_factor("));
//! # Ok::<(), moment_shadows::ShaderError>(())
//! ```
//!
//! [Every module and function](https://github.com/moment-shadows/moment-shadows/blob/main/docs/wgsl.md) is on one page. Nodes that make
//! and filter shadow maps, and the short path from an engine's own depth to a picture, `Session`, are in the crate
//! `moment-shadows-graph`, where
//! [the graph file](https://github.com/moment-shadows/moment-shadows/blob/main/docs/graph_file.md) connects them; its [README](https://github.com/moment-shadows/moment-shadows#start) begins there.
//!
//! The import lines are WESL, so the same text works in hosts that read WESL. `validate()` (feature `validate`, on by
//! default) checks a shader under a [`Profile`] and writes it for every backend; its errors point at the lines before linking.
//! `export()` writes a technique as functions for engines whose shaders are HLSL, GLSL or MSL.

// A technique, a storage or a format is never taken for another one.
#![warn(clippy::wildcard_enum_match_arm)]

/// Numbers that stand in WGSL, and only there.
#[allow(
    dead_code,
    clippy::excessive_precision,
    clippy::approx_constant,
    reason = "made of all of WGSL's numbers, as they stand there"
)]
mod constants {
    include!(concat!(env!("OUT_DIR"), "/constants.rs"));
}

mod area_light;
mod blend;
mod depth;
#[cfg(feature = "validate")]
#[allow(
    clippy::wildcard_enum_match_arm,
    reason = "of the compiler's many expressions and types functions use a few"
)]
mod export;
mod format;
mod kernel;
mod leak_reduction;
mod link;
mod map_region;
mod moment_bias;
mod nearest;
mod profile;
mod receiver_bias;
mod resolution;
mod scattering_way;
mod single_scattering;
mod storage;
mod summed_area_table;
mod techniques;
#[cfg(feature = "validate")]
#[allow(
    clippy::wildcard_enum_match_arm,
    reason = "of the compiler's many expressions and statements a check is about a few"
)]
mod validate;
mod value_error;
mod view;

pub use area_light::{AreaLight, LightSize};
pub use blend::{BlendComponent, BlendFactor, BlendState, Opacity};
pub use depth::{DepthConversion, DepthRange};
#[cfg(feature = "validate")]
pub use export::{Bits, Exported, FunctionVectors, Target, VectorRow, Vectors, export};
pub use format::{FormatSupport, TextureFormat};
pub use kernel::Kernel;
pub use leak_reduction::LeakReduction;
pub use link::{Linked, Location, Module, Rule, ShaderError, Source, compact, link, modules};
pub use map_region::MapRegion;
pub use moment_bias::{FourMomentsBias, SixMomentsBias};
pub use nearest::nearest;
pub use profile::Profile;
pub use receiver_bias::ReceiverBias;
pub use resolution::Resolution;
pub use scattering_way::{AirLight, ScatteringWay};
pub use single_scattering::SingleScattering;
pub use storage::Storage;
pub use summed_area_table::SummedAreaTable;
pub use techniques::{
    Blended, EsmFiltering, Finite, LayerSplits, MapEncoding, PcfTaps, Row, Technique,
};
#[cfg(feature = "validate")]
pub use validate::{
    Backend, COMPILER_THREAD, Features, UnknownFeature, ValidationOptions, ValidationReport,
    validate,
};
pub use value_error::ValueError;

pub use view::{
    Atlas, Border, CameraView, CascadeSplits, Cascades, CompositeScatteringParameters,
    ContactShadowParameters, ContactShadows, HeightFog, HeightFogView,
    IntegrateScatteringParameters, LightDepth, LightView, MarchScatteringParameters, MarchedAir,
    PointLight, PunctualLight, RectifiedFrame, RectifiedView, RectifyMomentsParameters,
    ScatteringParameters, SpotCone, Tile, UpsampleScatteringParameters, ViewParameters,
};

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

#[cfg(doctest)]
#[doc = include_str!("../docs/views.md")]
struct Views;
