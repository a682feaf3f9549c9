//! Resampling without any filter, to compare with.

use moment_shadows::TextureFormat;
use moment_shadows_graph::nodes::RectifyMoments;
use moment_shadows_graph::{
    Capabilities, Connected, GraphError, GraphErrorKind, Node, NodeDesc, ResourceDesc,
};
use serde::Deserialize;

/// Node `rectify_nearest`: [`RectifyMoments`] of a float32 map that reads the texel nearest to each light ray and no other, as
/// rectified depth maps are made of plain ones (Klehm et al., "Prefiltered Single Scattering", i3D 2014).
#[derive(Clone, Debug, Deserialize)]
#[serde(transparent)]
pub struct RectifyNearest(RectifyMoments);

/// The lookup of maps that are read by loads.
const BILINEAR: &str = "return map_load_bilinear(moments_map, layer, region, uv, 0u);";

/// What takes its place. The place is half a texel and more within the region.
const NEAREST: &str =
    "return textureLoad(moments_map, vec2i(floor(map_region_place(region, uv))), layer, 0);";

impl Node for RectifyNearest {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let moments = upstream.texture("map")?;
        let refused = || {
            let reason =
                "only maps of rgba32float without mip levels are resampled without a filter";
            GraphError::new(GraphErrorKind::Format, reason).at_slot("map")
        };
        if moments.format != TextureFormat::Rgba32Float || moments.mips != 1 {
            return Err(refused());
        }
        let inputs = [("map".to_owned(), ResourceDesc::Texture(moments.clone()))].into();
        // No sampler then.
        let capabilities = Capabilities {
            float32_filterable: false,
            ..upstream.capabilities().clone()
        };
        let mut desc = self.0.describe(&Connected::new(&inputs, &capabilities))?;
        for pass in &mut desc.passes {
            if !pass.wgsl.contains(BILINEAR) {
                return Err(refused());
            }
            pass.wgsl = pass.wgsl.replace(BILINEAR, NEAREST);
        }
        Ok(desc)
    }
}
