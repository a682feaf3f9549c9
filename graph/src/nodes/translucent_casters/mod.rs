//! Where the host blends translucent casters into a map, before it is filtered.

use serde::Deserialize;

use super::shared::{map_input, range_input, wrong_format};
use crate::{Connected, GraphError, Node, NodeDesc, Off, Pass, Slot, Stage};

/// Node `translucent_casters`: `map`, which the host blends translucent casters into, is handed on. Its pass is the host's, once per
/// layer: all texture layers of that layer are its colour targets, and its fragments are those of the WGSL module
/// `translucent_casters`, blended as [`moment_shadows::MapEncoding::blend_states`] says, far to near from the light. The node that makes
/// the map says how many casters lie over each other (`blends`).
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct TranslucentCasters {}

impl Node for TranslucentCasters {
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError> {
        let (map, encoding) = map_input::connected(upstream, "map")?;
        if encoding.blends() == 0 {
            return Err(wrong_format(format!(
                "the map holds {encoding} without a bias for casters that are blended into it; give the node that makes it the property \
                 'blends', the most casters that lie over each other"
            ))
            .at_slot("map"));
        }
        range_input::refuse(map, "takes casters whose depths are")?;
        if map.mips > 1 {
            return Err(wrong_format(format!(
                "the map has room for {} mip levels, and casters are drawn to one; give the node 'blur' behind this one the property \
                 'mip_levels' instead",
                map.mips
            ))
            .at_slot("map"));
        }
        let description =
            "The map: of opaque casters as it comes, with translucent ones as it goes.";
        let rule = map_input::rule(map_input::formats());
        Ok(NodeDesc::new("translucent_casters", Stage::AfterShadowMaps)
            .slots([Slot::in_out("map", description, rule)])
            .pass(
                Pass::host("translucent casters", &["map"], None)
                    .blended()
                    .each_layer(),
            )
            .off("map", Off::Bypass("map".to_owned())))
    }
}
