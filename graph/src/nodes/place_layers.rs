//! Places the layers of a layered variance shadow map where light would bleed.

use moment_shadows::{DepthConversion, LayerSplits, Technique, TextureFormat};
use serde::{Deserialize, Serialize};

use super::specialization::Specialization;
use super::{region_tiles, techniques};
use crate::{
    Access, Binding, BindingResource, Connected, CountRule, Direction, ExtentRule, FormatRule,
    GraphError, Lifetime, Node, NodeDesc, ParameterBlock, Pass, Slot, SlotResource, Stage, Work,
};

const SHADER: &str = include_str!("place_layers.wgsl");

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
/// is, do not count. Parameters: a [`DepthConversion`] per
/// layer and region, the same as those of `resolve`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlaceLayers {
    /// Layers of the technique, 1 to 8: as many as the map has.
    #[serde(default = "four")]
    pub layers: u32,
}

fn four() -> u32 {
    4
}

impl Default for PlaceLayers {
    fn default() -> Self {
        Self { layers: four() }
    }
}

impl Node for PlaceLayers {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let technique = Technique::Lvsm {
            layers: self.layers,
            overlap: Default::default(),
            splits: LayerSplits::Lloyd,
        };
        technique.check().map_err(techniques::property)?;
        let depth = upstream.texture("depth")?;
        let texture = if depth.samples > 1 {
            "texture_depth_multisampled_2d"
        } else {
            "texture_depth_2d"
        };
        let specialization = Specialization::new(upstream.capabilities())
            .alias("DepthTexture", texture)
            .constant("LAYERS", &format!("{}u", self.layers));
        let wgsl = region_tiles::specialize(specialization, depth).link(
            "place_layers.wgsl",
            SHADER,
            &[],
        )?;
        // All passes follow the layers of the depth map; those of a single workgroup cover it whole.
        let pass = |label: &str, entry_point: &str, texels_per_workgroup, bindings| Pass {
            label: label.to_owned(),
            wgsl: wgsl.clone(),
            entry_point: entry_point.to_owned(),
            bindings,
            constants: [].into(),
            plane: 0,
            work: Work::Compute {
                covers: "depth".to_owned(),
                texels_per_workgroup,
                each_layer: true,
            },
        };
        Ok(NodeDesc {
            name: "place_layers".to_owned(),
            stage: Stage::AfterShadowMaps,
            slots: slots(depth.size.map(|side| side.div_ceil(TILE))),
            passes: vec![
                pass(
                    "sum tiles",
                    "sum_tiles",
                    [TILE; 2],
                    vec![
                        Binding {
                            binding: 0,
                            resource: BindingResource::Parameters,
                        },
                        read(1, "depth"),
                        read(2, "state"),
                        write(3, "sums"),
                        region_tiles::binding("depth", 1),
                    ],
                ),
                pass(
                    "step splits",
                    "step_splits",
                    depth.size,
                    vec![read(2, "state"), write(3, "next"), read(5, "sums")],
                ),
                pass(
                    "keep splits",
                    "keep_splits",
                    depth.size,
                    vec![read(2, "next"), write(3, "state"), write(6, "splits")],
                ),
            ],
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

fn read(binding: u32, slot: &str) -> Binding {
    Binding {
        binding,
        resource: BindingResource::Layer(slot.to_owned()),
    }
}

fn write(binding: u32, slot: &str) -> Binding {
    Binding {
        binding,
        resource: BindingResource::StorageLayer(slot.to_owned()),
    }
}

/// The slots, for so many tiles.
fn slots(tiles: [u32; 2]) -> Vec<Slot> {
    let made = |name: &str, direction, lifetime, size| Slot {
        name: name.to_owned(),
        direction,
        lifetime,
        optional: false,
        resource: SlotResource::Texture {
            access: Access::READ.union(Access::STORAGE_WRITE),
            format: FormatRule::Exact(TextureFormat::Rgba32Float),
            extent: ExtentRule::Exact(size),
            layers: CountRule::SameAs("depth".to_owned()),
            mips: CountRule::Exact(1),
            samples: CountRule::Exact(1),
        },
    };
    vec![
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
        made("splits", Direction::Out, Lifetime::Persistent, [2, 1]),
        made("state", Direction::Internal, Lifetime::Persistent, STATE),
        made("next", Direction::Internal, Lifetime::Frame, STATE),
        made("sums", Direction::Internal, Lifetime::Frame, tiles),
    ]
}
