//! The input `map` that nodes share: a filterable map that knows its encoding.

use moment_shadows::TextureFormat::{
    R16Float, R16Unorm, R32Float, Rg16Float, Rg16Unorm, Rg32Float, Rgb10a2Unorm, Rgba8Unorm,
    Rgba16Float, Rgba16Unorm, Rgba32Float,
};
use moment_shadows::{MapEncoding, Technique, TextureFormat};

use crate::{Connected, GraphError, GraphErrorKind, Rule, TextureDesc, TextureRule};

/// The formats that a filterable map can have.
pub(in crate::nodes) const FORMATS: [TextureFormat; 11] = [
    Rgba16Unorm,
    Rgba16Float,
    Rgba32Float,
    Rg16Unorm,
    Rg16Float,
    Rg32Float,
    R16Unorm,
    R16Float,
    R32Float,
    Rgba8Unorm,
    Rgb10a2Unorm,
];

/// A map of these formats, with any number of layers and mip levels.
pub(in crate::nodes) fn rule(formats: &[TextureFormat]) -> TextureRule {
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

/// The map of four moments that is connected to a slot, for a node that does `what` with it.
pub(in crate::nodes) fn of_four_moments<'a>(
    upstream: &Connected<'a>,
    what: &str,
) -> Result<(&'a TextureDesc, MapEncoding), GraphError> {
    let (map, encoding) = connected(upstream, "map")?;
    if encoding.technique().shares_map_with(&Technique::Hamburger4) {
        return Ok((map, encoding));
    }
    Err(format_error(format!(
        "the map holds {encoding}; this node {what} four moments: give the node that makes the map the technique \
         'hamburger4'"
    ))
    .at_slot("map"))
}

/// The encoding of a filterable map other than a table: four moments, unless the map says otherwise.
pub(in crate::nodes) fn encoding_of(map: &TextureDesc) -> Result<MapEncoding, GraphError> {
    if map.format.is_integer() {
        return Err(format_error(format!(
            "{} holds a summed-area table, which only nodes for soft shadows read; connect the map that it is made of",
            map.format
        )));
    }
    let encoding = map.encoding.clone();
    encoding
        .or_else(|| MapEncoding::of_four_moments(map.format))
        .ok_or_else(|| {
            format_error(format!(
                "{} holds no moments; connect a map of moments, or say in its description how it is encoded",
                map.format
            ))
        })
}

fn format_error(message: String) -> GraphError {
    GraphError::new(GraphErrorKind::Format, message)
}
