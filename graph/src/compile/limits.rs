//! What a device allows of a texture.

use moment_shadows::{Profile, Storage};

use crate::GraphErrorKind::{Capability, Format, Size};
use crate::error::ensure;
use crate::{Access, Capabilities, GraphError, TextureDesc};

/// Whether the device can have such a texture.
pub(super) fn limits(texture: &TextureDesc, capabilities: &Capabilities) -> Result<(), GraphError> {
    let TextureDesc {
        size: [width, height],
        layers,
        mips,
        regions,
        planes,
        samples,
        ..
    } = *texture;
    let largest = capabilities.max_texture_size;
    let empty = [width, height, layers, mips, regions, planes].contains(&0);
    ensure(!empty, Size, || {
        format!(
            "the texture is empty ({texture}); it has at least one layer, plane, mip level and region, and sides from 1 to {largest}"
        )
    })?;
    counts(texture, capabilities)?;
    ensure(
        samples <= 1 || mips <= 1,
        Format,
        || "the texture is multisampled and has mip levels; no device has both",
    )?;
    let allowed = &capabilities.depth_samples;
    let offered = samples == 1 || allowed.contains(&samples);
    ensure(offered, Capability, || {
        let counts: Vec<String> = allowed.iter().map(u32::to_string).collect();
        let counts = counts.join(" or ");
        let more = match capabilities.profile {
            Profile::NativeAdapter => "",
            Profile::WebgpuTier1 => "",
            Profile::WebgpuCore | Profile::Native => {
                "; adapters that have more allow them with the feature TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES"
            }
        };
        format!("the texture has {samples} samples per texel; the device allows {counts}{more}")
    })
}

/// Whether the device can have as many texels, layers, planes and mip levels: nodes make passes for some of them.
pub(super) fn counts(texture: &TextureDesc, capabilities: &Capabilities) -> Result<(), GraphError> {
    let TextureDesc {
        format,
        planes,
        mips,
        size: [width, height],
        ..
    } = texture;
    let largest = capabilities.max_texture_size;
    ensure(*width.max(height) <= largest, Size, || {
        format!("the texture has {width}x{height} texels; the device allows {largest} per side")
    })?;
    let (layers, most) = (texture.array_layers(), capabilities.max_texture_layers);
    ensure(layers <= most, Size, || {
        format!("the texture has {layers} layers; the device allows {most}")
    })?;
    if let Some(encoding) = &texture.encoding {
        let (of_format, of_planes) = (encoding.format(), encoding.planes());
        ensure((of_format, of_planes) == (*format, *planes), Format, || {
            format!(
                "the texture is to hold {encoding}, but has {planes} planes of {format}; that takes {of_planes} of {of_format}"
            )
        })?;
    }
    let most = width.max(height).max(&1).ilog2() + 1;
    ensure(*mips <= most, Size, || {
        format!("the texture has {mips} mip levels; {width}x{height} texels have at most {most}")
    })
}

/// Whether the profile allows what passes do with the format.
pub(super) fn usable(
    texture: &TextureDesc,
    access: Access,
    capabilities: &Capabilities,
) -> Result<(), GraphError> {
    let (format, profile) = (texture.format, capabilities.profile);
    let support = capabilities.support(format);
    let fails = |missing: &str| {
        let storage = match &texture.encoding {
            Some(encoding) => encoding.technique().best_storage(profile),
            None => Storage::of_format(format).map(|_| Storage::best_for(profile)),
        };
        let alternative = storage.map_or_else(
            || "use another format".to_owned(),
            |storage| format!("use storage '{storage}', which works there"),
        );
        format!("{format} cannot be {missing} under the profile {profile}; {alternative}")
    };
    let stored = !access.storage_write || support.storage_write;
    ensure(stored, Capability, || {
        let feature = format.features_to_write();
        let or = format!("; request the device with {feature}, or use ");
        fails("written as a storage texture").replacen("; use ", &or, 1)
    })?;
    let drawn = !access.render_target || support.renderable;
    ensure(drawn, Capability, || match format.features_to_blend() {
        Some(features) => format!(
            "{format} cannot be drawn to under the profile {profile}; request the device with {features}, or use storage 'float16'"
        ),
        None => fails("drawn to"),
    })
}
