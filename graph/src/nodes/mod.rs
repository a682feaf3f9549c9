//! The library's nodes. Each is a pair: a declaration here, and thin WGSL entry points beside it.

mod blur;
mod composite_scattering;
mod debug_moments;
mod downsample;
mod drawn_map;
mod integrate_scattering;
mod kernel_property;
mod mip_levels;
mod moments_input;
mod moments_lookup;
mod place_layers;
mod rectify_moments;
mod region_tiles;
mod resolve;
mod shade_hard;
mod shade_soft;
mod shading;
mod specialization;
mod summed_area_table;
mod techniques;
mod unrolled;

pub use blur::{Blur, BlurParameters};
pub use composite_scattering::{CompositeScattering, Overestimation};
pub use debug_moments::{DebugMoments, Show};
pub use downsample::Downsample;
pub use integrate_scattering::{IntegrateScattering, Medium};
pub use kernel_property::KernelProperty;
pub use mip_levels::{AllLevels, MipLevels};
pub use place_layers::PlaceLayers;
pub use rectify_moments::RectifyMoments;
pub use resolve::Resolve;
pub use shade_hard::{ShadeHard, TechniqueShader};
pub use shade_soft::{Interpolation, ShadeSoft};
pub use summed_area_table::{LargestKernel, SummedAreaTable};
