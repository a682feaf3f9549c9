//! The plan's formats and usages in wgpu's terms.

use moment_shadows::TextureFormat;

use crate::{TextureDesc, Usage};

impl TextureDesc {
    /// The format in wgpu's terms.
    #[must_use]
    pub fn wgpu_format(&self) -> wgpu::TextureFormat {
        wgpu_format(self.format)
    }
}

/// A format in wgpu's terms.
pub(super) fn wgpu_format(format: TextureFormat) -> wgpu::TextureFormat {
    match format {
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
        TextureFormat::R32Uint => wgpu::TextureFormat::R32Uint,
        TextureFormat::Rg32Uint => wgpu::TextureFormat::Rg32Uint,
        TextureFormat::Rgba32Uint => wgpu::TextureFormat::Rgba32Uint,
        TextureFormat::Depth16Unorm => wgpu::TextureFormat::Depth16Unorm,
        TextureFormat::Depth32Float => wgpu::TextureFormat::Depth32Float,
        TextureFormat::Depth24Plus => wgpu::TextureFormat::Depth24Plus,
        TextureFormat::Depth24PlusStencil8 => wgpu::TextureFormat::Depth24PlusStencil8,
        TextureFormat::Depth32FloatStencil8 => wgpu::TextureFormat::Depth32FloatStencil8,
    }
}

pub(super) fn texture_usages(usages: &[Usage]) -> wgpu::TextureUsages {
    let usages = usages.iter().map(|usage| match usage {
        Usage::CopySrc => wgpu::TextureUsages::COPY_SRC,
        Usage::TextureBinding => wgpu::TextureUsages::TEXTURE_BINDING,
        Usage::StorageBinding => wgpu::TextureUsages::STORAGE_BINDING,
        Usage::RenderAttachment => wgpu::TextureUsages::RENDER_ATTACHMENT,
        // No texture has it.
        Usage::Storage => wgpu::TextureUsages::empty(),
    });
    usages.collect()
}

/// What differs between a texture and its description, as a sentence's end; `None` if nothing does.
pub(super) fn texture_difference(
    texture: &wgpu::Texture,
    desc: &TextureDesc,
    layers: u32,
    usage: &[Usage],
) -> Option<String> {
    let usages = texture_usages(usage);
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
