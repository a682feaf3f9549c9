//! What the passes of the competitors have in common.

use moment_shadows::{Source, TextureFormat, link};
use moment_shadows_graph::TextureDesc;

use crate::error::LabError;
use crate::gpu::Gpu;
use crate::pass::{Bound, Pass, Work};
use crate::texture::texture;

/// What the radiance of all candidates is stored as.
pub(super) const RADIANCE: TextureFormat = TextureFormat::Rgba16Float;

/// Links a shader of this folder with what every competitor is told.
pub(super) fn linked(name: &str, text: &str) -> Result<String, LabError> {
    let view = Source {
        name: "scattering_view",
        text: include_str!("view.wgsl"),
    };
    Ok(link(Source { name, text }, &[view])?.into_wgsl())
}

/// A texture of radiance that is drawn, sampled and read back.
pub(super) fn target(gpu: &Gpu, label: &str, size: [u32; 2]) -> wgpu::Texture {
    let usage = wgpu::TextureUsages::RENDER_ATTACHMENT
        | wgpu::TextureUsages::TEXTURE_BINDING
        | wgpu::TextureUsages::COPY_SRC;
    texture(gpu, label, &TextureDesc::new(RADIANCE, size), usage)
}

/// A pass of a linked shader over all of a texture.
pub(super) fn draw(
    gpu: &Gpu,
    wgsl: String,
    constants: &[(&str, f64)],
    bound: &[(u32, Bound<'_>)],
    target: &wgpu::Texture,
) -> Pass {
    let work = Work::Draw(target.create_view(&Default::default()));
    Pass::new(gpu, "scattering", wgsl, constants, bound, work)
}

/// A whole texture, bound.
pub(super) fn whole<'a>(texture: &wgpu::Texture) -> Bound<'a> {
    Bound::Texture(texture.create_view(&Default::default()))
}

/// Bilinear, clamped to the edge.
pub(super) fn sampler(gpu: &Gpu) -> wgpu::Sampler {
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("scattering/bilinear"),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    })
}
