//! Turns a light's depth map into a map of moments.

use moment_shadows::{DepthConversion, MapEncoding, Storage, Technique, TextureFormat};
use serde::{Deserialize, Serialize};

use super::specialization::{FULLSCREEN, Specialization};
use super::{MipLevels, drawn_map, region_tiles, techniques};
use crate::{
    Access, Binding, BindingResource, Connected, CountRule, Direction, ExtentRule, FormatRule,
    GraphError, Lifetime, Node, NodeDesc, ParameterBlock, Pass, Slot, SlotResource, Stage,
};

const SHADER: &str = include_str!("resolve.wgsl");
const SHADER_DRAWN: &str = include_str!("resolve_drawn.wgsl");
const TEXEL: &str = include_str!("resolve_texel.wgsl");

/// Node `resolve`: `depth` (1, 2, 4 or 8 samples of depth32float or depth16unorm, any number of layers) to
/// `moments`, a filterable map of the same size, layers and regions, encoded for a technique. The *moments* (or what else the
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
        let texture = if depth.samples > 1 {
            "texture_depth_multisampled_2d"
        } else {
            "texture_depth_2d"
        };
        let mips = self.mip_levels.count(depth.size)?;
        let technique = &self.technique;
        let encoding =
            MapEncoding::new(technique.clone(), self.storage).map_err(techniques::property)?;
        let specialization = Specialization::new(upstream.capabilities())
            .alias("DepthTexture", texture)
            .constant("SAMPLES", &depth.samples.to_string());
        let specialization = techniques::specialize_map(specialization, &encoding);
        let drawn = self.storage.is_drawn();
        let (file, shader) = if drawn {
            ("resolve_drawn.wgsl", SHADER_DRAWN)
        } else {
            ("resolve.wgsl", SHADER)
        };
        let mut modules = vec![
            ("resolve_texel", TEXEL),
            techniques::encoding(technique),
            ("technique_layers", techniques::layers(technique, true)),
        ];
        if drawn {
            modules.extend([drawn_map::MODULE, FULLSCREEN]);
        } else {
            modules.push(region_tiles::MODULE);
        }
        let wgsl = region_tiles::specialize(specialization, depth).link(file, shader, &modules)?;
        let splits = techniques::places_layers(technique).then(|| techniques::splits_input(true));
        let pass = |plane: u32| {
            let mut bindings = vec![
                Binding {
                    binding: 0,
                    resource: BindingResource::Parameters,
                },
                Binding {
                    binding: 1,
                    resource: BindingResource::Layer("depth".to_owned()),
                },
                region_tiles::binding("map", 1),
            ];
            bindings.extend(drawn_map::binding(&encoding, 2, "map", 0));
            bindings.extend(splits.iter().map(|(_, binding)| binding.clone()));
            let (label, constants) = if techniques::encodes_planes(technique) {
                (
                    format!("resolve plane {plane}"),
                    [("PLANE".to_owned(), f64::from(plane))].into(),
                )
            } else {
                ("resolve".to_owned(), [].into())
            };
            Pass {
                label,
                wgsl: wgsl.clone(),
                entry_point: "resolve".to_owned(),
                bindings,
                constants,
                plane,
                work: drawn_map::work(&encoding, "map", 0, [8, 8]),
            }
        };
        let passes = (0..encoding.planes()).map(pass).collect();
        Ok(NodeDesc {
            name: "resolve".to_owned(),
            stage: Stage::AfterShadowMaps,
            slots: [
                Slot {
                    name: "depth".to_owned(),
                    direction: Direction::In,
                    lifetime: Lifetime::Frame,
                    optional: false,
                    resource: SlotResource::Texture {
                        access: Access::READ,
                        format: FormatRule::OneOf(vec![
                            TextureFormat::Depth32Float,
                            TextureFormat::Depth16Unorm,
                        ]),
                        extent: ExtentRule::Any,
                        layers: CountRule::Any,
                        mips: CountRule::Any,
                        samples: CountRule::OneOf(vec![1, 2, 4, 8]),
                    },
                },
                Slot {
                    name: "map".to_owned(),
                    direction: Direction::Out,
                    lifetime: Lifetime::Frame,
                    optional: false,
                    resource: SlotResource::Texture {
                        access: drawn_map::write_access(&encoding),
                        format: FormatRule::Encoded(encoding),
                        extent: ExtentRule::SameAs("depth".to_owned()),
                        layers: CountRule::SameAs("depth".to_owned()),
                        mips: CountRule::Exact(mips),
                        samples: CountRule::Exact(1),
                    },
                },
            ]
            .into_iter()
            .chain(splits.map(|(slot, _)| slot))
            .collect(),
            passes,
            parameters: Some(ParameterBlock {
                name: "DepthConversion".to_owned(),
                size: size_of::<DepthConversion>() as u32,
                elements: depth.regions,
                each_layer_of: Some("depth".to_owned()),
                initial: bytemuck::bytes_of(&DepthConversion::orthographic()).to_vec(),
            }),
        })
    }
}
