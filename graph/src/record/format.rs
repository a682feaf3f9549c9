//! The plan's formats and usages in wgpu's terms.

use moment_shadows::TextureFormat;

use crate::{Access, TextureDesc};

impl TextureDesc {
    /// The format in wgpu's terms.
    #[must_use]
    pub fn wgpu_format(&self) -> wgpu::TextureFormat {
        match self.format {
            TextureFormat::R8Unorm => wgpu::TextureFormat::R8Unorm,
            TextureFormat::Rgba8Unorm => wgpu::TextureFormat::Rgba8Unorm,
            TextureFormat::R16Unorm => wgpu::TextureFormat::R16Unorm,
            TextureFormat::Rg16Unorm => wgpu::TextureFormat::Rg16Unorm,
            TextureFormat::R16Float => wgpu::TextureFormat::R16Float,
            TextureFormat::Rg16Float => wgpu::TextureFormat::Rg16Float,
            TextureFormat::R32Float => wgpu::TextureFormat::R32Float,
            TextureFormat::Rg32Float => wgpu::TextureFormat::Rg32Float,
            TextureFormat::Rgb10a2Unorm => wgpu::TextureFormat::Rgb10a2Unorm,
            TextureFormat::Rgba16Unorm => wgpu::TextureFormat::Rgba16Unorm,
            TextureFormat::Rgba16Float => wgpu::TextureFormat::Rgba16Float,
            TextureFormat::Rgba32Float => wgpu::TextureFormat::Rgba32Float,
            TextureFormat::Rg32Uint => wgpu::TextureFormat::Rg32Uint,
            TextureFormat::Rgba32Uint => wgpu::TextureFormat::Rgba32Uint,
            TextureFormat::Depth16Unorm => wgpu::TextureFormat::Depth16Unorm,
            TextureFormat::Depth32Float => wgpu::TextureFormat::Depth32Float,
            TextureFormat::Depth24Plus => wgpu::TextureFormat::Depth24Plus,
            TextureFormat::Depth24PlusStencil8 => wgpu::TextureFormat::Depth24PlusStencil8,
            TextureFormat::Depth32FloatStencil8 => wgpu::TextureFormat::Depth32FloatStencil8,
        }
    }
}

pub(super) fn texture_usages(access: Access, exported: bool) -> wgpu::TextureUsages {
    let mut usages = wgpu::TextureUsages::empty();
    usages.set(
        wgpu::TextureUsages::TEXTURE_BINDING,
        access.read || exported,
    );
    usages.set(wgpu::TextureUsages::STORAGE_BINDING, access.storage_write);
    usages.set(wgpu::TextureUsages::RENDER_ATTACHMENT, access.render_target);
    usages.set(wgpu::TextureUsages::COPY_SRC, exported);
    usages
}

/// What differs between a texture and its description, as a sentence's end; `None` if nothing does.
pub(super) fn texture_difference(
    texture: &wgpu::Texture,
    desc: &TextureDesc,
    layers: u32,
    access: Access,
) -> Option<String> {
    let usages = texture_usages(access, false);
    let text = |format: wgpu::TextureFormat, [width, height]: [u32; 2], layers, mips, samples| {
        format!("{format:?} {width}x{height} x {layers} layers, {mips} mips, {samples} samples")
    };
    let (size, mips) = (
        [texture.width(), texture.height()],
        texture.mip_level_count(),
    );
    let (array_layers, samples) = (texture.depth_or_array_layers(), texture.sample_count());
    let found = text(texture.format(), size, array_layers, mips, samples);
    if found
        != text(
            desc.wgpu_format(),
            desc.size,
            layers,
            desc.mips,
            desc.samples,
        )
    {
        return Some(found);
    }
    let missing = usages - texture.usage();
    (!missing.is_empty()).then(|| format!("without the usage {missing:?}"))
}
