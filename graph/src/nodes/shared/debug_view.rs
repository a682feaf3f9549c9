//! What nodes that shade can show of how they shade.

use moment_shadows::{Technique, TextureFormat};
use serde::Deserialize;

use super::{Specialization, wrong_property};
use crate::{GraphError, Rule, Slot, TextureRule};

/// What the output `debug` of a node that shades shows of each pixel, by the first view that contains it. Grey is where none does, black
/// where there is no surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum DebugView {
    /// A hue per view: a cascade, a face, a spot.
    View,
    /// Texels of the map along the longer side of a pixel: blue at an eighth, green at one, red at eight.
    Texels,
    /// The width of the filter in pixels: blue at a quarter, green at four, red at 64. Of a filtered map it is the standard deviation,
    /// of soft shadows half the width.
    Filter,
    /// Where surfaces lie in the range of depth that the map has: black at the near end, white at the far end; red before it, blue
    /// beyond.
    Range,
    /// The mean depth of blockers as soft shadows find it, in that range; blue where less than a hundredth of the search is blocked.
    Blockers,
    /// Half the width in texels of what soft shadows filter: blue at a half, green at four, red at 32.
    Penumbra,
    /// A hue per layer of a layered variance shadow map.
    Layer,
}

impl DebugView {
    /// The modules by which it is shown, of a technique. `soft` says whether that is evaluated from a summed-area table.
    pub(super) fn modules(
        self,
        specialization: Specialization,
        technique: &Technique,
        soft: bool,
    ) -> Result<Specialization, GraphError> {
        let row = technique.row();
        let blockers = row
            .technique_blockers()
            .filter(|_| soft || row.reads_depth());
        let refused = |lacks: &str| {
            Err(wrong_property(format!(
                "'debug' asks for what '{technique}' does not have here: {lacks}"
            )))
        };
        let colour = match self {
            DebugView::View => include_str!("debug/view.wgsl"),
            DebugView::Texels => include_str!("debug/texels.wgsl"),
            DebugView::Filter => include_str!("debug/filter.wgsl"),
            DebugView::Range => include_str!("debug/range.wgsl"),
            DebugView::Blockers => include_str!("debug/blockers.wgsl"),
            DebugView::Penumbra => include_str!("debug/penumbra.wgsl"),
            DebugView::Layer => include_str!("debug/layer.wgsl"),
        };
        let specialization = specialization
            .module("debug_colours", include_str!("debug/debug_colours.wgsl"))
            .module("debug_colour", colour);
        let of_penumbra = include_str!("debug/width_of_penumbra.wgsl");
        let of_kernel = include_str!("debug/width_of_kernel.wgsl");
        match (self, blockers) {
            (DebugView::View | DebugView::Texels | DebugView::Range, _) => Ok(specialization),
            (DebugView::Layer, _) => match row.technique_layer() {
                Some(layer) => Ok(specialization.module("technique_layer", layer)),
                None => refused("layers"),
            },
            (DebugView::Blockers | DebugView::Penumbra | DebugView::Filter, Some(blockers)) => {
                Ok(specialization
                    .module("technique_blockers", blockers)
                    .module("filter_width", of_penumbra))
            }
            (DebugView::Filter, None) if !row.reads_depth() => {
                Ok(specialization.module("filter_width", of_kernel))
            }
            (DebugView::Filter, None) => refused("a filtered map"),
            (DebugView::Blockers | DebugView::Penumbra, None) => refused("a search for blockers"),
        }
    }
}

/// The output.
pub(super) fn slot() -> Slot {
    let rule = TextureRule::new(TextureFormat::Rgba8Unorm).extent(Rule::same_as("camera_depth"));
    Slot::output("debug", "How each pixel is shaded, as a colour.", rule)
}
