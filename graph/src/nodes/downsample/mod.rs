//! Fills the mip levels of a map of moments.

use serde::{Deserialize, Serialize};

use super::shared::{NoProperties, Specialization, map_input, regions, wgsl};
use super::techniques;
use crate::{Connected, GraphError, GraphErrorKind, Node, NodeDesc, Slot, Stage, bind};

/// Node `downsample`: fills the mip levels of `map` in place, within each region. The map has room for them
/// where the node that made it says so (`mip_levels`). One pass per level; each texel is the mean over what it covers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "NoProperties", into = "NoProperties")]
pub struct Downsample;

impl Node for Downsample {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let (map, encoding) = map_input::connected(upstream, "map")?;
        let refused = |kind, message| Err(GraphError::new(kind, message).at_slot("map"));
        if map.mips < 2 {
            return refused(
                GraphErrorKind::Size,
                "the map has one mip level, so there is nothing to fill; set 'mip_levels' of the node that makes it to a number \
                 or \"all\"",
            );
        }
        if techniques::is_logarithmic(encoding.technique()) {
            return refused(
                GraphErrorKind::Property,
                "a map that is filtered logarithmically has no mip levels, since no lookup could average them; use the \
                 filtering 'linear'",
            );
        }
        let specialization =
            techniques::specialize_map(Specialization::new(upstream.capabilities()), &encoding);
        let shader = if encoding.storage().is_drawn() {
            wgsl!("downsample_drawn.wgsl")
        } else {
            wgsl!("downsample.wgsl")
        };
        let mut modules = vec![("downsample_texel", include_str!("downsample_texel.wgsl"))];
        modules.extend(regions::modules(&encoding));
        let wgsl = regions::specialize(specialization, map).link(shader, &modules)?;
        let each = (1..map.mips).flat_map(|level| (0..map.planes).map(move |plane| (level, plane)));
        let passes = each.map(|(level, plane)| {
            let label = match map.planes {
                1 => format!("mip level {level}"),
                _ => format!("plane {plane}: mip level {level}"),
            };
            regions::write(label, &encoding, ("map", level), "coarser_level", [8, 8], 1)
                .shader(wgsl.as_str(), "downsample")
                .bind("finer_level", bind::level("map", level - 1))
                .constant("LEVEL", level)
                .plane(plane)
        });
        let description = "The map; its mip levels but the first are filled.";
        let rule = map_input::rule(&map_input::FORMATS);
        Ok(NodeDesc::new("downsample", Stage::AfterShadowMaps)
            .slots([Slot::in_out("map", description, rule)])
            .passes(passes))
    }
}
