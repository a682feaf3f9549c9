//! Techniques as virtual modules: how a node's shader encodes, filters and evaluates the map that it is described for.
//!
//! All of it comes from the technique's row ([`moment_shadows::Row`]).

use moment_shadows::{MapEncoding, Row, Technique};

use super::shared::Specialization;
use crate::{Binding, CountRule, GraphError, GraphErrorKind, Slot, TextureRule, bind};

/// The name and text of a virtual module.
pub(super) type VirtualModule = (&'static str, &'static str);

/// The slot of these splits: one layer per layer of the map, the splits in two texels.
pub(super) const SPLITS: &str = "splits";

/// Whether the encoding has a constant for the plane that it makes.
pub(super) fn encodes_planes(technique: &Technique) -> bool {
    technique.row().encodes_planes()
}

/// The moments of a technique that single scattering has both bounds of.
pub(super) enum Bounded {
    Four,
    Six,
}

/// Which moments single scattering has both bounds of, if any.
pub(super) fn both_bounds(technique: &Technique) -> Option<Bounded> {
    let row = technique.row();
    let moments = if row.planes == 1 {
        Bounded::Four
    } else {
        Bounded::Six
    };
    row.both_bounds.then_some(moments)
}

/// Whether texels are logarithms, which no sampler can average.
pub(super) fn is_logarithmic(technique: &Technique) -> bool {
    !technique.row().averaged_by_samplers
}

/// What a technique is told about a surface.
const RECEIVER: VirtualModule = (
    "technique_receiver",
    include_str!("techniques/receiver.wgsl"),
);

/// The constants of a row.
fn constants(specialization: Specialization, row: &Row) -> Specialization {
    row.constants().fold(specialization, |all, (name, value)| {
        all.constant(name, value)
    })
}

/// How a fragment is shaded: the constants and the module `technique`, and what that imports.
pub(super) fn evaluation(
    specialization: Specialization,
    technique: &Technique,
) -> (Specialization, Vec<VirtualModule>) {
    let row = technique.row();
    let map = match (row.reads_depth(), row.comparison) {
        (false, _) => include_str!("techniques/map_filterable.wgsl"),
        (true, None) => include_str!("techniques/map_depth.wgsl"),
        (true, Some(_)) => include_str!("techniques/map_depth_compared.wgsl"),
    };
    let modules = vec![
        ("technique_map", map),
        RECEIVER,
        ("map_texel", include_str!("techniques/map_texel.wgsl")),
        ("technique_layers", layers(technique, false)),
    ];
    let specialization = constants(specialization, &row).module("technique", row.technique());
    (specialization, modules)
}

/// How a fragment is shaded softly from the summed-area table of a map. A technique that has no soft shadows is refused.
pub(super) fn soft_evaluation(
    specialization: Specialization,
    technique: &Technique,
) -> Result<(Specialization, [VirtualModule; 3]), GraphError> {
    let row = technique.row();
    let Some(text) = row.soft_technique() else {
        return Err(GraphError::new(
            GraphErrorKind::Format,
            format!(
                "there are no soft shadows by '{technique}'; give the node that makes the map the technique 'hamburger4' or 'vsm'"
            ),
        ));
    };
    let modules = [
        ("technique_map", include_str!("techniques/map_table.wgsl")),
        ("technique_soft", include_str!("techniques/soft.wgsl")),
        RECEIVER,
    ];
    Ok((specialization.module("technique", text), modules))
}

/// Where the layers of a layered variance shadow map lie: `technique_layers`, in a pass for one layer of the map or for all.
pub(super) fn layers(technique: &Technique, one_layer: bool) -> &'static str {
    if !places_layers(technique) {
        include_str!("techniques/layers_known.wgsl")
    } else if one_layer {
        include_str!("techniques/layers_placed_one.wgsl")
    } else {
        include_str!("techniques/layers_placed.wgsl")
    }
}

/// Whether the splits come from the input [`SPLITS`].
pub(super) fn places_layers(technique: &Technique) -> bool {
    technique.row().places_layers
}

/// The input for the splits, and its binding.
pub(super) fn splits_input(one_layer: bool) -> (Slot, Binding) {
    let rule = TextureRule::new(moment_shadows::TextureFormat::Rgba32Float)
        .extent([2, 1])
        .layers(CountRule::Any);
    let slot = Slot::input(SPLITS, "Where the layers of the technique lie.", rule);
    let bound = if one_layer { bind::layer } else { bind::layers };
    let binding = Binding::new("splits_map", bound(SPLITS));
    (slot, binding)
}

/// Storage texture (of maps that are not drawn), storage, and the modules `map_encoding` and `map_filtering`: what the shaders of a
/// map's filters import.
pub(super) fn specialize_map(
    mut specialization: Specialization,
    encoding: &MapEncoding,
) -> Specialization {
    let storage = encoding.storage();
    if !storage.is_drawn() {
        let texture = format!("texture_storage_2d<{}, write>", encoding.format());
        specialization = specialization.alias("MomentsStorage", &texture);
    }
    let row = encoding.technique().row();
    let specialization = specialization.constant("STORAGE", &format!("{}u", storage.wgsl_index()));
    constants(specialization, &row)
        .module("map_encoding", row.map_encoding())
        .module("map_filtering", row.map_filtering())
}

/// A technique's error at a node.
pub(super) fn property(error: impl core::fmt::Display) -> GraphError {
    GraphError::new(GraphErrorKind::Property, error.to_string())
}
