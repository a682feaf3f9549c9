//! Fills the mip levels of a map of moments.

use serde::{Deserialize, Serialize};

use super::moments_input::{map_formats, moments_input};
use super::specialization::{FULLSCREEN, Specialization};
use super::{drawn_map, region_tiles, techniques};
use crate::{
    Access, Binding, BindingResource, Connected, CountRule, Direction, ExtentRule, FormatRule,
    GraphError, GraphErrorKind, Lifetime, MipLevel, Node, NodeDesc, Pass, Slot, SlotResource,
    Stage,
};

const SHADER: &str = include_str!("downsample.wgsl");
const SHADER_DRAWN: &str = include_str!("downsample_drawn.wgsl");
const TEXEL: &str = include_str!("downsample_texel.wgsl");

/// Node `downsample`: fills the mip levels of `moments` in place, within each region. The map has room for them
/// where the node that made it says so (`mip_levels`). One pass per level; each texel is the mean over what it covers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Downsample {}

impl Node for Downsample {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let (moments, encoding) = moments_input(upstream)?;
        if moments.mips < 2 {
            return Err(GraphError::new(
                GraphErrorKind::Size,
                "the map has one mip level, so there is nothing to fill; set 'mip_levels' of the node that makes it to a number \
                 or \"all\"",
            )
            .at_slot("map"));
        }
        if techniques::is_logarithmic(encoding.technique()) {
            return Err(GraphError::new(
                GraphErrorKind::Property,
                "a map that is filtered logarithmically has no mip levels, since no lookup could average them; use the \
                 filtering 'linear'",
            )
            .at_slot("map"));
        }
        let specialization = Specialization::new(upstream.capabilities());
        let specialization = techniques::specialize_map(specialization, &encoding);
        let drawn = encoding.storage().is_drawn();
        let (file, shader) = if drawn {
            ("downsample_drawn.wgsl", SHADER_DRAWN)
        } else {
            ("downsample.wgsl", SHADER)
        };
        let mut modules = vec![
            ("downsample_texel", TEXEL),
            techniques::filtering(encoding.technique()),
        ];
        if drawn {
            modules.extend([drawn_map::MODULE, FULLSCREEN]);
        } else {
            modules.push(region_tiles::MODULE);
        }
        let wgsl =
            region_tiles::specialize(specialization, moments).link(file, shader, &modules)?;
        let bindings = |level: u32| {
            let finer = Binding {
                binding: 0,
                resource: BindingResource::Level(MipLevel {
                    slot: "map".to_owned(),
                    level: level - 1,
                }),
            };
            [finer, region_tiles::binding("map", 1)]
                .into_iter()
                .chain(drawn_map::binding(&encoding, 1, "map", level))
                .collect()
        };
        let passes = (1..moments.mips)
            .flat_map(|level| (0..moments.planes).map(move |plane| (level, plane)))
            .map(|(level, plane)| Pass {
                label: match moments.planes {
                    1 => format!("mip level {level}"),
                    _ => format!("plane {plane}: mip level {level}"),
                },
                plane,
                wgsl: wgsl.clone(),
                entry_point: "downsample".to_owned(),
                bindings: bindings(level),
                constants: [("LEVEL".to_owned(), f64::from(level))].into(),
                work: drawn_map::work(&encoding, "map", level, [8, 8]),
            })
            .collect();
        Ok(NodeDesc {
            name: "downsample".to_owned(),
            stage: Stage::AfterShadowMaps,
            slots: vec![Slot {
                name: "map".to_owned(),
                direction: Direction::InOut,
                lifetime: Lifetime::Frame,
                optional: false,
                resource: SlotResource::Texture {
                    access: Access::READ.union(drawn_map::write_access(&encoding)),
                    format: FormatRule::OneOf(map_formats()),
                    extent: ExtentRule::Any,
                    layers: CountRule::Any,
                    mips: CountRule::Any,
                    samples: CountRule::Exact(1),
                },
            }],
            passes,
            parameters: None,
        })
    }
}
