//! Fills the mip levels of a map of moments.

use serde::Deserialize;

use super::shared::{map_input, regions, wrong_property, wrong_size};
use super::techniques;
use crate::{Connected, GraphError, Node, NodeDesc, Slot, Stage, bind};

/// Node `downsample`: fills the mip levels of `map` in place, within each region. The map has room for them
/// where the node that made it says so (`mip_levels`). One pass per level; each texel is the mean over what it covers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Downsample {}

impl Node for Downsample {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let (map, encoding) = map_input::connected(upstream, "map")?;
        if map.mips < 2 {
            let message = "the map has one mip level, so there is nothing to fill; set 'mip_levels' of the node that makes it to a \
                           number or \"all\"";
            return Err(wrong_size(message).at_slot("map"));
        }
        if !encoding.averaged_by_samplers() {
            let message = "a map that is filtered logarithmically or stored as packed texels has no mip levels, since no lookup could \
                           average them; use the filtering 'linear' and a storage whose channels are not packed";
            return Err(wrong_property(message).at_slot("map"));
        }
        let wgsl = techniques::of_map(upstream.capabilities(), &encoding)
            .unsigned("REGIONS", map.regions)
            .module("written_texel", include_str!("downsample_texel.wgsl"))
            .link(regions::shader(&encoding))?;
        let passes = (1..map.mips).flat_map(|level| {
            let label = format!("mip level {level}");
            let pass = regions::write(label, &wgsl, &encoding, ("map", level), [8, 8], 1)
                .bind("finer_level", bind::level("map", level - 1))
                .constant("LEVEL", level);
            regions::of_each_plane(map.planes, vec![pass])
        });
        let description = "The map; its mip levels but the first are filled.";
        let rule = map_input::rule(map_input::formats());
        Ok(NodeDesc::new("downsample", Stage::AfterShadowMaps)
            .slots([Slot::in_out("map", description, rule)])
            .passes(passes))
    }
}
