//! The input `map` that nodes share: a filterable map that knows its encoding.

use moment_shadows::{MapEncoding, Storage, Technique, TextureFormat};

use super::wrong_format;
use crate::{Connected, GraphError, Rule, TextureDesc, TextureRule};

/// The formats that a filterable map can have whose channels lie in textures as they are: those of all storages but packed ones and
/// that of tables.
pub(in crate::nodes) fn formats() -> Vec<TextureFormat> {
    let storages = Storage::ALL.into_iter();
    storages
        .flat_map(|storage| [4, 2, 1].map(|channels| storage.format_of(channels)))
        .flatten()
        .filter(|format| !format.is_integer())
        .collect()
}

/// The formats that a filterable map can have, packed ones included.
pub(in crate::nodes) fn all_formats() -> Vec<TextureFormat> {
    let packed = Storage::ALL.into_iter().filter(|it| it.is_packed());
    let mut formats = formats();
    formats.extend(packed.map(Storage::format));
    formats
}

/// Refuses a map of packed texels, for a node that reads channels as they are.
pub(in crate::nodes) fn refuse_packed(encoding: &MapEncoding) -> Result<(), GraphError> {
    let storage = encoding.storage();
    if !storage.is_packed() {
        return Ok(());
    }
    let readers = if storage.is_written_once() {
        "the node 'shade_hard' reads"
    } else {
        "the nodes 'blur' and 'shade_hard' read"
    };
    Err(wrong_format(format!(
        "the map is stored as '{storage}', in packed texels, which {readers}; use 'float16', 'unorm16' or 'float32' here"
    ))
    .at_slot("map"))
}

/// Refuses a map that is written once, for a node that filters it.
pub(in crate::nodes) fn refuse_written_once(encoding: &MapEncoding) -> Result<(), GraphError> {
    let storage = encoding.storage();
    if !storage.is_written_once() {
        return Ok(());
    }
    Err(wrong_format(format!(
        "the map is stored as '{storage}', which is rounded too coarsely to be filtered; give this node 'resolve' with that storage in place \
         of the map, or store the map as 'packed64'"
    ))
    .at_slot("map"))
}

/// A map of these formats, with any number of layers and mip levels.
pub(in crate::nodes) fn rule(formats: impl Into<Rule<TextureFormat>>) -> TextureRule {
    TextureRule::new(formats).layers(Rule::Any).mips(Rule::Any)
}

/// The map that is connected to a slot, and its encoding: four moments, unless the map says otherwise.
pub(in crate::nodes) fn connected<'a>(
    upstream: &Connected<'a>,
    slot: &str,
) -> Result<(&'a TextureDesc, MapEncoding), GraphError> {
    let map = upstream.texture(slot)?;
    Ok((map, encoding_of(map).map_err(|error| error.at_slot(slot))?))
}

/// The same for a node of single scattering, which reads maps in rectified coordinates.
pub(in crate::nodes) fn connected_rectified<'a>(
    upstream: &Connected<'a>,
    slot: &str,
) -> Result<(&'a TextureDesc, MapEncoding), GraphError> {
    let map = upstream.texture(slot)?;
    let encoding = any_encoding_of(map).map_err(|error| error.at_slot(slot))?;
    Ok((map, encoding))
}

/// The map of four moments that is connected to a slot, for a node that does `what` with it.
pub(in crate::nodes) fn of_four_moments<'a>(
    upstream: &Connected<'a>,
    what: &str,
) -> Result<(&'a TextureDesc, MapEncoding), GraphError> {
    let (map, encoding) = connected(upstream, "map")?;
    if encoding
        .technique()
        .row()
        .shares_map_with(&Technique::Hamburger4.row())
    {
        return Ok((map, encoding));
    }
    Err(wrong_format(format!(
        "the map holds {encoding}; this node {what} four moments: give the node that makes the map the technique \
         'hamburger4'"
    ))
    .at_slot("map"))
}

/// Refuses a map with translucent casters, for a node that has no bias for them.
pub(in crate::nodes) fn refuse_blended(encoding: &MapEncoding) -> Result<(), GraphError> {
    if encoding.blends() == 0 {
        return Ok(());
    }
    Err(wrong_format(format!(
        "the map has up to {} translucent casters over each other, whose bias this node does not know: 'shade_hard' does; connect a map \
         without 'blends' here",
        encoding.blends()
    ))
    .at_slot("map"))
}

/// The encoding of a filterable map other than a table: four moments, unless the map says otherwise. One whose storage suffices in
/// rectified coordinates alone is refused.
pub(in crate::nodes) fn encoding_of(map: &TextureDesc) -> Result<MapEncoding, GraphError> {
    let encoding = any_encoding_of(map)?;
    if !encoding.is_rectified() {
        return Ok(encoding);
    }
    Err(wrong_format(format!(
        "the map holds {encoding}, which suffices for means along view rays alone: the nodes 'integrate_scattering' and \
         'composite_scattering' read it"
    )))
}

fn any_encoding_of(map: &TextureDesc) -> Result<MapEncoding, GraphError> {
    let is_packed = map
        .encoding
        .as_ref()
        .is_some_and(|it| it.storage().is_packed());
    if map.format.is_integer() && !is_packed {
        return Err(wrong_format(format!(
            "{} holds a summed-area table, which only nodes for soft shadows read; connect the map that it is made of",
            map.format
        )));
    }
    let encoding = map.encoding.clone();
    encoding
        .or_else(|| MapEncoding::of_four_moments(map.format))
        .ok_or_else(|| {
            wrong_format(format!(
                "{} holds no moments; connect a map of moments, or say in its description how it is encoded",
                map.format
            ))
        })
}
