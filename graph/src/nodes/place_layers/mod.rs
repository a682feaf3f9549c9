//! Places the layers of a layered variance shadow map where light would bleed.

use moment_shadows::{LayerSplits, Technique, TextureFormat};
use serde::Deserialize;

use super::shared::regions::ENDLESS;
use super::shared::{Specialization, depth_input, wgsl, wrong_property};
use crate::{
    Connected, GraphError, Node, NodeDesc, Off, Pass, Rule, Slot, Stage, TextureRule, bind,
};

/// Footprints that a workgroup sums up, along each side (`TILE` in the shader).
const TILE: u32 = 32;

/// Texels of the state (see the shader).
const STATE: [u32; 2] = [5, 1];

/// Node `place_layers`: `depth` (as `resolve` takes it) to `splits`, for nodes that make or read a map of the
/// technique `lvsm` whose splits are `lloyd`. The regions of a layer of the map share its splits.
///
/// Each time a layer is dirty, Lloyd relaxation moves two of its splits towards the surfaces behind which light would bleed
/// (Lauritzen & McCool, "Layered Variance Shadow Maps", GI 2008, section 5). It starts from layers of equal depth and goes on
/// from where it was: `splits` and its state are persistent, and all zeros at first. Edges against the far end, where no caster
/// is, do not count. Parameters: a [`moment_shadows::DepthConversion`] per layer and region, the same as those of `resolve`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(default, deny_unknown_fields)]
pub struct PlaceLayers {
    /// Layers of the technique, 1 to 8: as many as the map has.
    pub layers: u32,
}

impl Default for PlaceLayers {
    fn default() -> Self {
        Self { layers: 4 }
    }
}

impl Node for PlaceLayers {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let technique = Technique::Lvsm {
            layers: self.layers,
            overlap: Default::default(),
            splits: LayerSplits::Lloyd,
        };
        technique.check().map_err(wrong_property)?;
        let depth = upstream.texture("depth")?;
        let wgsl = Specialization::new(upstream.capabilities())
            .alias("DepthTexture", depth_input::texture_type(depth))
            .unsigned("REGIONS", depth.regions)
            .unsigned("LAYERS", self.layers)
            .link(wgsl!("place_layers.wgsl"))?;
        // All passes follow the layers of the depth map; those of a single workgroup cover it whole.
        let pass = |label: &str, entry_point: &str, texels| {
            Pass::compute(label, "depth", texels)
                .each_layer()
                .shader(wgsl.as_str(), entry_point)
        };
        let made = |size: [u32; 2]| {
            TextureRule::new(TextureFormat::Rgba32Float)
                .extent(size)
                .layers(Rule::same_as("depth"))
        };
        let tiles = TextureRule::new(TextureFormat::Rgba32Float).tiles_of("depth", [TILE; 2]);
        let state = "Where the relaxation is, layer by layer.";
        Ok(NodeDesc::new("place_layers", Stage::AfterShadowMaps)
            .input("depth", "The light's depth map.", depth_input::light())
            .slots([
                Slot::output("splits", "Where the layers lie.", made([2, 1])).persistent(),
                Slot::internal("state", state, made(STATE)).persistent(),
                Slot::internal("next", "Where it is after this step.", made(STATE)),
                Slot::internal("sums", "What each tile says about the splits.", tiles),
            ])
            .pass(
                pass("sum tiles", "sum_tiles", [TILE; 2])
                    .bind("conversions", bind::parameters())
                    .bind("depth_map", bind::layer("depth"))
                    .bind("state_map", bind::layer("state"))
                    .bind("target_map", bind::store("sums"))
                    .bind("regions", bind::regions("depth", 1)),
            )
            .pass(
                pass("step splits", "step_splits", [ENDLESS; 2])
                    .bind("state_map", bind::layer("state"))
                    .bind("target_map", bind::store("next"))
                    .bind("sums_map", bind::layer("sums")),
            )
            .pass(
                pass("keep splits", "keep_splits", [ENDLESS; 2])
                    .bind("state_map", bind::layer("next"))
                    .bind("target_map", bind::store("state"))
                    .bind("splits_map", bind::store("splits")),
            )
            .parameters(depth_input::conversions(depth))
            // Layers of equal depth.
            .off("splits", Off::Fill(vec![[0.0; 4]])))
    }
}
