//! The chains whose flicker is compared.

use moment_shadows::Storage;
use serde_json::json;

use crate::error::LabError;
use crate::graph_file::GraphFile;
use crate::scattering::chain::{Link, graph};

/// Texels, as in the example's graph.
const RADIUS: u32 = 2;

/// A chain of nodes from the light's depth to radiance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Chain {
    /// The chain of the example: several samples per texel, a blur, bilinear lookups.
    Filtered,
    /// The chain of the example with mip levels, over which lookups average what a texel of the rectified map covers.
    MipLevels,
    /// One sample per texel and no blur, but bilinear lookups.
    Bilinear,
    /// One sample per texel, no blur, and lookups of the nearest texel.
    Unfiltered,
}

impl Chain {
    /// All chains.
    pub const ALL: [Chain; 4] = [
        Chain::Filtered,
        Chain::MipLevels,
        Chain::Bilinear,
        Chain::Unfiltered,
    ];

    /// What tables call it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Chain::Filtered => "filtered",
            Chain::MipLevels => "filtered, mip levels",
            Chain::Bilinear => "unfiltered, bilinear",
            Chain::Unfiltered => "unfiltered",
        }
    }

    /// Whether the light's map has one sample per texel.
    #[must_use]
    pub fn is_plain(self) -> bool {
        matches!(self, Chain::Bilinear | Chain::Unfiltered)
    }

    /// The graph, with rectified maps of this extent.
    pub fn graph(self, extent: [u32; 2]) -> Result<GraphFile, LabError> {
        let rectify = match self {
            Chain::Unfiltered => "rectify_nearest",
            Chain::Filtered | Chain::MipLevels | Chain::Bilinear => "rectify_moments",
        };
        let properties =
            json!({ "technique": "hamburger6", "storage": "float16", "extent": extent });
        let mut links = match self {
            Chain::Filtered => {
                vec![Link::resolve(Storage::Float16), Link::blur(RADIUS, None)]
            }
            Chain::MipLevels => vec![
                Link::resolve(Storage::Float16),
                Link::blur(RADIUS, Some("all")),
                Link("downsample", json!({}), ["map", "map"]),
            ],
            Chain::Bilinear | Chain::Unfiltered => vec![Link::resolve(Storage::Float32)],
        };
        links.extend([
            Link(rectify, properties, ["map", "rectified"]),
            Link(
                "integrate_scattering",
                json!({}),
                ["rectified", "integrated"],
            ),
            Link(
                "composite_scattering",
                json!({}),
                ["integrated", "scattering"],
            ),
        ]);
        graph(self.name(), &links)
    }
}
