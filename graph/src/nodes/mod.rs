//! The library's nodes. Each is a folder: its description in Rust, and its WGSL. What several nodes share lies in `shared`.

mod blur;
mod composite_scattering;
mod contact_shadows;
mod debug_moments;
mod downsample;
mod fit_range;
mod integrate_scattering;
mod march_scattering;
mod place_layers;
mod rectify_moments;
mod resolve;
mod shade_hard;
mod shade_soft;
mod shared;
mod summed_area_table;
mod techniques;
mod translucent_casters;
mod upsample_scattering;

pub use blur::{Blur, BlurKernel};
pub use composite_scattering::CompositeScattering;
pub use contact_shadows::ContactShadows;
pub use debug_moments::{DebugMoments, Show};
pub use downsample::Downsample;
pub use fit_range::FitRange;
#[cfg(feature = "wgpu")]
pub(crate) use fit_range::SEES;
pub use integrate_scattering::IntegrateScattering;
pub use march_scattering::MarchScattering;
pub use place_layers::PlaceLayers;
pub use rectify_moments::RectifyMoments;
pub use resolve::Resolve;
pub use shade_hard::ShadeHard;
pub use shade_soft::ShadeSoft;
pub use shared::debug_view::DebugView;
#[cfg(feature = "wgpu")]
pub(crate) use shared::shading::BORDERS;
pub use summed_area_table::SummedAreaTable;
pub use translucent_casters::TranslucentCasters;
pub use upsample_scattering::UpsampleScattering;

use crate::NodeRegistry;

/// Registers the nodes by the names that graph files use.
pub(crate) fn register(registry: &mut NodeRegistry) {
    registry.register::<Resolve>("resolve");
    registry.register::<FitRange>("fit_range");
    registry.register::<PlaceLayers>("place_layers");
    registry.register::<TranslucentCasters>("translucent_casters");
    registry.register::<Blur>("blur");
    registry.register::<Downsample>("downsample");
    registry.register::<SummedAreaTable>("summed_area_table");
    registry.register::<DebugMoments>("debug_moments");
    registry.register::<ShadeHard>("shade_hard");
    registry.register::<ShadeSoft>("shade_soft");
    registry.register::<ContactShadows>("contact_shadows");
    registry.register::<RectifyMoments>("rectify_moments");
    registry.register::<IntegrateScattering>("integrate_scattering");
    registry.register::<CompositeScattering>("composite_scattering");
    registry.register::<MarchScattering>("march_scattering");
    registry.register::<UpsampleScattering>("upsample_scattering");
}

/// Properties that a file may ask for in vain: node, property and the reason why no node has it.
pub(crate) const REFUSED: [(&str, &str, &str); 2] = [
    (
        "shade_hard",
        "moment_scale",
        "moments times a constant are the moments of no distribution, so that the result bounds nothing; use the leak \
         reduction of the node's parameters instead",
    ),
    (
        "integrate_scattering",
        "medium",
        "all view rays of a row share its sums, which they can in a homogeneous medium alone: leave it out, or let a node \
         'march_scattering' march a density that differs from place to place",
    ),
];
