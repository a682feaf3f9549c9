//! The library's nodes. Each is a pair: a declaration here, and thin WGSL entry points beside it.

mod blur_moments;
mod debug_moments;
mod downsample_moments;
mod kernel_property;
mod mip_levels;
mod moments_input;
mod place_layers;
mod region_tiles;
mod resolve_moments;
mod shade_hard;
mod specialization;
mod summed_area_table;
mod techniques;
mod unrolled;

pub use blur_moments::{BlurMoments, BlurParameters};
pub use debug_moments::{DebugMoments, Show};
pub use downsample_moments::DownsampleMoments;
pub use kernel_property::KernelProperty;
pub use mip_levels::{AllLevels, MipLevels};
pub use place_layers::PlaceLayers;
pub use resolve_moments::ResolveMoments;
pub use shade_hard::{
    CameraView, LightDepth, LightView, ShadeHard, ShadeHardParameters, TechniqueShader, ViewError,
};
pub use summed_area_table::{LargestKernel, SummedAreaTable};
