//! Techniques as modules: how a node's shader encodes, filters and evaluates the map that it is described for.
//!
//! All of it comes from the technique's row ([`moment_shadows::Row`]).

use moment_shadows::{MapEncoding, Storage, Technique, TextureFormat};

use super::shared::{Specialization, regions, wrong_format};
use crate::{Binding, Capabilities, GraphError, Off, Pass, Rule, Slot, TextureRule, bind};

/// What single scattering takes for maps of a technique that it has both bounds of, which are of four moments or of six.
pub(super) fn of_both_bounds<T>(technique: &Technique, four: T, six: T) -> Option<T> {
    let row = technique.row();
    let moments = if row.planes == 1 { four } else { six };
    row.both_bounds.then_some(moments)
}

/// A map that casts no shadow, in place of one that a node makes.
pub(super) fn no_shadow(encoding: &MapEncoding) -> Off {
    let row = encoding.technique().row();
    let texels = row.far_texels(encoding.storage()).unwrap_or_default();
    if encoding.storage() == Storage::Packed32 {
        // The greatest depth in the lowest bits, and no distance to a second one.
        return Off::Fill(vec![[4095.0, 0.0, 0.0, 0.0]]);
    }
    if !encoding.storage().is_packed() {
        return Off::Fill(texels.to_vec());
    }
    let word = |[low, high]: [f64; 2], largest: f64| {
        let [low, high] = [low, high].map(|it| (it * largest).round().rem_euclid(65536.0));
        low + 65536.0 * high
    };
    let packed = texels
        .iter()
        .map(|&[x, y, z, w]| [word([x, y], 32767.0), word([z, w], 65535.0), 0.0, 0.0]);
    Off::Fill(packed.collect())
}

/// The constants of a technique.
fn constants(specialization: Specialization, technique: &Technique) -> Specialization {
    let row = technique.row();
    row.constants().fold(specialization, |all, (name, value)| {
        all.constant(name, value)
    })
}

/// How a fragment is shaded: the constants and the module `technique`, and what that imports.
///
/// `map` is how the map is encoded, none for the plain depth map: one that translucent casters were blended into, or whose texels
/// are rounded inwards, is evaluated with the bias for that.
pub(super) fn evaluation(
    specialization: Specialization,
    technique: &Technique,
    map: Option<&MapEncoding>,
) -> Specialization {
    let row = technique.row();
    let blends = map.map_or(0, MapEncoding::blends);
    let inwards = map.is_some_and(MapEncoding::is_rounded_inwards);
    let blended = row.blended_technique().filter(|_| blends > 0);
    let rounded_inwards = row.rounded_inwards_technique().filter(|_| inwards);
    let technique_map = if row.reads_depth() {
        include_str!("techniques/map_depth.wgsl")
    } else {
        include_str!("techniques/map_filterable.wgsl")
    };
    let specialization = constants(specialization, technique).unsigned("PLANES", row.planes);
    let specialization = match &blended {
        Some(_) => specialization.unsigned("BLENDS", blends),
        None => specialization,
    };
    specialization
        .module(
            "technique",
            blended
                .or(rounded_inwards)
                .unwrap_or_else(|| row.technique()),
        )
        .module("technique_map", technique_map)
        .module("technique_layers", layers(technique, false))
}

/// How a fragment is shaded softly from the summed-area table of a map. A technique that has no soft shadows is refused.
pub(super) fn soft_evaluation(
    specialization: Specialization,
    technique: &Technique,
) -> Result<Specialization, GraphError> {
    let Some(text) = technique.row().soft_technique() else {
        return Err(wrong_format(format!(
            "there are no soft shadows by '{technique}'; give the node that makes the map the technique 'hamburger4' or 'vsm'"
        )));
    };
    Ok(specialization
        .module("technique", text)
        .module("technique_map", include_str!("techniques/map_table.wgsl"))
        .module("technique_soft", include_str!("techniques/soft.wgsl")))
}

/// Where the layers of a layered variance shadow map lie: `technique_layers`, in a pass for one layer of the map or for all.
pub(super) fn layers(technique: &Technique, one_layer: bool) -> &'static str {
    match (technique.row().places_layers, one_layer) {
        (false, _) => include_str!("techniques/layers_known.wgsl"),
        (true, true) => include_str!("techniques/layers_placed_one.wgsl"),
        (true, false) => include_str!("techniques/layers_placed.wgsl"),
    }
}

/// The input for the splits and its binding, where layers are placed on the device: a slot with one layer per layer of the map,
/// the splits in two texels.
pub(super) fn splits(technique: &Technique, one_layer: bool) -> (Option<Slot>, Option<Binding>) {
    if !technique.row().places_layers {
        return (None, None);
    }
    let rule = TextureRule::new(TextureFormat::Rgba32Float)
        .extent([2, 1])
        .layers(Rule::Any);
    let slot = Slot::input("splits", "Where the layers of the technique lie.", rule);
    let bound = if one_layer { bind::layer } else { bind::layers };
    let binding = Binding::new("splits_map", bound("splits"));
    (Some(slot), Some(binding))
}

/// How texels lie in textures: the module `map_texture`.
pub(super) fn map_texture(encoding: &MapEncoding) -> &'static str {
    match encoding.storage() {
        Storage::Packed32 => include_str!("techniques/map_texture_coarse.wgsl"),
        Storage::Packed64 => include_str!("techniques/map_texture_packed.wgsl"),
        Storage::Unorm16
        | Storage::Float16
        | Storage::Float32
        | Storage::Unorm8
        | Storage::Unorm10
        | Storage::Fixed32 => include_str!("techniques/map_texture_channels.wgsl"),
    }
}

/// The type of textures of the map, storage texture (of maps that are not drawn), storage, and the modules `map_texture`, `map_encoding` and `map_filtering`: what the shaders of a
/// map's filters import.
pub(super) fn of_map(capabilities: &Capabilities, encoding: &MapEncoding) -> Specialization {
    let (storage, technique) = (encoding.storage(), encoding.technique());
    let texel = if storage.is_packed() { "u32" } else { "f32" };
    let mut specialization = Specialization::new(capabilities)
        .alias("MapTexture", &format!("texture_2d<{texel}>"))
        .module("map_texture", map_texture(encoding));
    if !storage.is_drawn() {
        let texture = format!("texture_storage_2d<{}, write>", encoding.format());
        specialization = specialization.alias("MomentsStorage", &texture);
    }
    let row = technique.row();
    constants(specialization, technique)
        .unsigned("STORAGE", storage.wgsl_index())
        .module("map_encoding", row.map_encoding())
        .module("map_filtering", row.map_filtering())
}

/// This pass for each plane of a map that is encoded, told which where the encoding asks.
pub(super) fn of_each_plane(encoding: &MapEncoding, pass: Pass) -> impl Iterator<Item = Pass> {
    let asks = encoding.technique().row().encodes_planes();
    regions::of_each_plane(encoding.planes(), vec![pass]).map(move |pass| match pass.plane {
        plane if asks => pass.constant("PLANE", plane),
        _ => pass,
    })
}
