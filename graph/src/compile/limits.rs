//! What a device allows of a texture.

use moment_shadows::Storage;

use crate::{Access, Capabilities, GraphError, GraphErrorKind, TextureDesc};

/// Whether the device can have such a texture.
pub(super) fn limits(texture: &TextureDesc, capabilities: &Capabilities) -> Result<(), GraphError> {
    let largest = capabilities.max_texture_size;
    let counts = [
        texture.layers,
        texture.mips,
        texture.regions,
        texture.planes,
    ];
    if texture.size.contains(&0) || counts.contains(&0) {
        return Err(GraphError::new(
            GraphErrorKind::Size,
            format!(
                "the texture is empty ({texture}); it has at least one layer, plane, mip level and region, and sides from 1 to {largest}"
            ),
        ));
    }
    if texture.size.iter().any(|&side| side > largest) {
        return Err(GraphError::new(
            GraphErrorKind::Size,
            format!(
                "the texture has {}x{} texels; the device allows {largest} per side",
                texture.size[0], texture.size[1]
            ),
        ));
    }
    if texture.array_layers() > capabilities.max_texture_layers {
        return Err(GraphError::new(
            GraphErrorKind::Size,
            format!(
                "the texture has {} layers; the device allows {}",
                texture.array_layers(),
                capabilities.max_texture_layers
            ),
        ));
    }
    if let Some(encoding) = &texture.encoding
        && (encoding.format(), encoding.planes()) != (texture.format, texture.planes)
    {
        return Err(GraphError::new(
            GraphErrorKind::Format,
            format!(
                "the texture is to hold {encoding}, but has {} planes of {}; that takes {} of {}",
                texture.planes,
                texture.format,
                encoding.planes(),
                encoding.format()
            ),
        ));
    }
    let most_mips = texture.size[0].max(texture.size[1]).ilog2() + 1;
    if texture.mips > most_mips {
        return Err(GraphError::new(
            GraphErrorKind::Size,
            format!(
                "the texture has {} mip levels; {}x{} texels have at most {most_mips}",
                texture.mips, texture.size[0], texture.size[1]
            ),
        ));
    }
    if texture.samples > 1 && texture.mips > 1 {
        return Err(GraphError::new(
            GraphErrorKind::Format,
            "the texture is multisampled and has mip levels; no device has both".to_owned(),
        ));
    }
    if texture.samples != 1 && !capabilities.depth_samples.contains(&texture.samples) {
        let counts: Vec<String> = capabilities
            .depth_samples
            .iter()
            .map(u32::to_string)
            .collect();
        return Err(GraphError::new(
            GraphErrorKind::Capability,
            format!(
                "the texture has {} samples per texel; the device allows {}",
                texture.samples,
                counts.join(" or ")
            ),
        ));
    }
    Ok(())
}

/// Whether the profile allows what passes do with the format.
pub(super) fn usable(
    texture: &TextureDesc,
    access: Access,
    capabilities: &Capabilities,
) -> Result<(), GraphError> {
    let format = texture.format;
    let support = capabilities.support(format);
    let missing = if access.storage_write && !support.storage_write {
        Some("written as a storage texture")
    } else if access.render_target && !support.renderable {
        Some("drawn to")
    } else {
        None
    };
    let Some(missing) = missing else {
        return Ok(());
    };
    let of_moments = Storage::of_format(format).map(|_| Storage::best_for(capabilities.profile));
    let storage = match &texture.encoding {
        Some(encoding) => encoding.technique().best_storage(capabilities.profile),
        None => of_moments,
    };
    let alternative = storage.map_or_else(
        || "use another format".to_owned(),
        |storage| format!("use storage '{storage}', which works there"),
    );
    Err(GraphError::new(
        GraphErrorKind::Capability,
        format!(
            "{format} cannot be {missing} under the profile {}; {alternative}",
            capabilities.profile
        ),
    ))
}
