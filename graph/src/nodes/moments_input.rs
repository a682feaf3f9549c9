//! The input `moments` that nodes share: a filterable map that knows its encoding.

use moment_shadows::MapEncoding;

use crate::{Connected, GraphError, GraphErrorKind, TextureDesc};

/// The map that is connected to the slot `moments`, and its encoding: four moments, unless the map says otherwise.
pub(super) fn moments_input<'a>(
    upstream: &Connected<'a>,
) -> Result<(&'a TextureDesc, MapEncoding), GraphError> {
    let moments = upstream.texture("map")?;
    Ok((moments, encoding_of(moments)?))
}

/// The encoding of a filterable map that is no table: four moments, unless the map says otherwise.
pub(super) fn encoding_of(moments: &TextureDesc) -> Result<MapEncoding, GraphError> {
    if moments.format.is_integer() {
        return Err(GraphError::new(
            GraphErrorKind::Format,
            format!(
                "{} holds a summed-area table, which only nodes for soft shadows read; connect the map that it is made of",
                moments.format
            ),
        )
        .at_slot("map"));
    }
    let encoding = moments
        .encoding
        .clone()
        .or_else(|| MapEncoding::of_four_moments(moments.format));
    encoding.ok_or_else(|| {
        GraphError::new(
            GraphErrorKind::Format,
            format!(
                "{} holds no moments; connect a map of moments, or say in its description how it is encoded",
                moments.format
            ),
        )
        .at_slot("map")
    })
}

/// The formats that a filterable map can have.
pub(super) fn map_formats() -> Vec<moment_shadows::TextureFormat> {
    use moment_shadows::TextureFormat::{
        R16Float, R16Unorm, R32Float, Rg16Float, Rg16Unorm, Rg32Float, Rgb10a2Unorm, Rgba8Unorm,
        Rgba16Float, Rgba16Unorm, Rgba32Float,
    };
    vec![
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
    ]
}
