//! Turns a light's depth map into a map of moments.

use moment_shadows::{DepthConversion, MapEncoding, Storage, Technique};
use serde::{Deserialize, Serialize};

use super::shared::{self, MipLevels, Specialization, regions, wgsl};
use super::techniques;
use crate::{Connected, GraphError, Node, NodeDesc, ParameterBlock, Stage, TextureRule, bind};

/// Node `resolve`: `depth` (1, 2, 4 or 8 samples of depth32float or depth16unorm, any number of layers) to
/// `map`, a filterable map of the same size, layers and regions, encoded for a technique. The *moments* (or what else the
/// technique stores) of the samples are averaged, not their depths, so edges are antialiased. With splits placed by Lloyd
/// relaxation there is a second input, `splits`. The storage `unorm10` is drawn by render passes, others are written by compute
/// shaders. Parameters: a [`DepthConversion`] per layer and region.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Resolve {
    /// What the map is made for; nodes that read it need not be told.
    #[serde(default)]
    pub technique: Technique,
    /// How the moments are stored.
    pub storage: Storage,
    /// Room for mip levels, for a map that is not blurred; [`super::Downsample`] fills it.
    #[serde(default)]
    pub mip_levels: MipLevels,
}

impl Node for Resolve {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let depth = upstream.texture("depth")?;
        let mips = self.mip_levels.count(depth.size)?;
        let technique = &self.technique;
        let encoding =
            MapEncoding::new(technique.clone(), self.storage).map_err(techniques::property)?;
        let specialization = Specialization::new(upstream.capabilities())
            .alias("DepthTexture", shared::depth_texture(depth))
            .constant("SAMPLES", &depth.samples.to_string());
        let specialization = techniques::specialize_map(specialization, &encoding);
        let shader = if self.storage.is_drawn() {
            wgsl!("resolve_drawn.wgsl")
        } else {
            wgsl!("resolve.wgsl")
        };
        let mut modules = vec![
            ("resolve_texel", include_str!("resolve_texel.wgsl")),
            ("technique_layers", techniques::layers(technique, true)),
        ];
        modules.extend(regions::modules(&encoding));
        let wgsl = regions::specialize(specialization, depth).link(shader, &modules)?;
        let splits = techniques::places_layers(technique).then(|| techniques::splits_input(true));
        let (splits, splits_binding) = splits.unzip();
        let passes = (0..encoding.planes()).map(|plane| {
            let named = techniques::encodes_planes(technique);
            let label = if named {
                format!("resolve plane {plane}")
            } else {
                "resolve".to_owned()
            };
            let mut pass = regions::write(label, &encoding, ("map", 0), "moments_map", [8, 8], 1)
                .shader(wgsl.as_str(), "resolve")
                .bind("conversions", bind::parameters())
                .bind("depth_map", bind::layer("depth"))
                .plane(plane);
            pass.bindings.extend(splits_binding.clone());
            if named {
                pass = pass.constant("PLANE", plane);
            }
            pass
        });
        Ok(NodeDesc::new("resolve", Stage::AfterShadowMaps)
            .input("depth", "The light's depth map.", shared::light_depth())
            .output(
                "map",
                "The filterable map, of the depth map's size, layers and regions.",
                TextureRule::of_map(encoding.clone())
                    .like("depth")
                    .mips(mips),
            )
            .slots(splits)
            .passes(passes)
            .parameters(
                ParameterBlock::of::<DepthConversion>("DepthConversion")
                    .elements(depth.regions)
                    .each_layer_of("depth")
                    .initial(&DepthConversion::orthographic()),
            ))
    }
}
