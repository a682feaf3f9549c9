//! The input `moments` that nodes share: a map whose format tells its storage.

use moment_shadows::Storage;

use crate::{Connected, GraphError, GraphErrorKind, TextureDesc};

/// The map of moments that is connected to the slot `moments`, and its storage.
pub(super) fn moments_input<'a>(
    upstream: &Connected<'a>,
) -> Result<(&'a TextureDesc, Storage), GraphError> {
    let moments = upstream.texture("moments")?;
    let storage = Storage::of_format(moments.format).ok_or_else(|| {
        GraphError::new(
            GraphErrorKind::Format,
            format!(
                "{} holds no moments; connect a map of moments",
                moments.format
            ),
        )
        .at_slot("moments")
    })?;
    Ok((moments, storage))
}
