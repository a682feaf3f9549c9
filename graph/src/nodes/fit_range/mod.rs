//! Fits the range of moment depth to the casters in a light's depth map.

use moment_shadows::TextureFormat;
use serde::Deserialize;

use super::shared::regions::ENDLESS;
use super::shared::{Specialization, depth_input, wgsl, wrong_size};
use crate::{
    Connected, GraphError, Node, NodeDesc, Off, Pass, Rule, Slot, Stage, TextureRule, bind,
};

/// Texels of the depth map for each workgroup that looks through it, along each side.
const TILE: u32 = 32;

/// Node `fit_range`: `depth` (as `resolve` takes it) to `ranges`, which `resolve` takes and then `shade_hard` or `shade_soft`, too.
/// Light leaks in proportion to the range of moment depth; with this node a host keeps a generous one, and each region of each
/// layer of its map gets what its casters need of it.
///
/// Each time a layer is dirty, the nearest and the farthest caster of each region are found. The range grows at once, and shrinks
/// where it is clearly too long: `ranges` is persistent. A region without casters keeps its range. Never does a range leave that of
/// the host. Receivers behind all casters count as lying at the far end; penumbrae of soft shadows are as wide there as at that
/// distance. Parameters: a [`moment_shadows::DepthConversion`] per layer and region, the same as those of `resolve`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct FitRange {}

impl Node for FitRange {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let depth = upstream.texture("depth")?;
        let [across, down] = depth.size.map(|side| side.div_ceil(TILE));
        if u64::from(across) * u64::from(down) < u64::from(depth.regions) {
            return Err(wrong_size(format!(
                "{} regions are more than {}x{} texels have tiles of {TILE}x{TILE}; describe the map with fewer regions",
                depth.regions, depth.size[0], depth.size[1]
            ))
            .at_slot("depth"));
        }
        let wgsl = Specialization::new(upstream.capabilities())
            .alias("DepthTexture", depth_input::texture_type(depth))
            .unsigned("REGIONS", depth.regions)
            .constant("SAMPLES", depth.samples)
            .link(wgsl!("fit_range.wgsl"))?;
        // All passes follow the layers of the depth map; those of a single workgroup cover it whole.
        let pass = |label: &str, texels| {
            Pass::compute(label, "depth", texels)
                .each_layer()
                .shader(wgsl.as_str(), &label.replace(' ', "_"))
        };
        let of_regions = || {
            TextureRule::new(TextureFormat::Rgba32Float)
                .extent([depth.regions, 1])
                .layers(Rule::same_as("depth"))
        };
        let ends = TextureRule::new(TextureFormat::Rgba32Float).tiles_of("depth", [TILE; 2]);
        let ranges = "The range of each region: its middle, how many times the host's is as long, and where the region begins.";
        Ok(NodeDesc::new("fit_range", Stage::AfterShadowMaps)
            .input("depth", "The light's depth map.", depth_input::light())
            .slots([
                Slot::output("ranges", ranges, of_regions().fitted_to("ranges")).persistent(),
                Slot::internal("ends", "The ends of what each workgroup sees.", ends),
                Slot::internal("next", "The ranges of this frame.", of_regions()),
            ])
            .pass(
                pass("find ends", [TILE; 2])
                    .bind("conversions", bind::parameters())
                    .bind("depth_map", bind::layer("depth"))
                    .bind("target_map", bind::store("ends"))
                    .bind("regions", bind::regions("depth", 1)),
            )
            .pass(
                pass("fit ranges", [ENDLESS; 2])
                    .bind("depth_map", bind::layer("depth"))
                    .bind("ranges_map", bind::layer("ranges"))
                    .bind("target_map", bind::store("next"))
                    .bind("ends_map", bind::layer("ends"))
                    .bind("regions", bind::regions("depth", 1)),
            )
            .pass(
                pass("keep ranges", [ENDLESS; 2])
                    .bind("ranges_map", bind::layer("next"))
                    .bind("target_map", bind::store("ranges")),
            )
            .parameters(depth_input::conversions(depth))
            // The host's ranges.
            .off("ranges", Off::Fill(vec![[0.0, 1.0, 0.0, 0.0]])))
    }
}
