//! Textures of one mip level and one sample.

use moment_shadows::TextureFormat;
use moment_shadows_graph::TextureDesc;
use wgpu::util::DeviceExt;

use crate::error::LabError;
use crate::gpu::Gpu;

/// A texture of all layers and planes of a description.
pub(crate) fn texture(
    gpu: &Gpu,
    label: &str,
    desc: &TextureDesc,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    gpu.device.create_texture(&descriptor(label, desc, usage))
}

/// A texture to be read, with these bytes layer by layer and row by row.
pub(crate) fn upload(gpu: &Gpu, desc: &TextureDesc, bytes: &[u8]) -> wgpu::Texture {
    let descriptor = descriptor("lab/upload", desc, wgpu::TextureUsages::TEXTURE_BINDING);
    let order = wgpu::util::TextureDataOrder::LayerMajor;
    (gpu.device).create_texture_with_data(&gpu.queue, &descriptor, order, bytes)
}

/// A depth map with a layer for each of these, of depth32float and of the same size.
pub(crate) fn layered(gpu: &Gpu, layers: &[wgpu::Texture]) -> Result<wgpu::Texture, LabError> {
    let first = layers.first();
    let first = first.ok_or_else(|| LabError::refused("a map of no layers; draw one at least"))?;
    let desc = TextureDesc {
        layers: layers.len() as u32,
        ..TextureDesc::new(TextureFormat::Depth32Float, [first.width(), first.height()])
    };
    let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST;
    let whole = texture(gpu, "lab/layers", &desc, usage);
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    for (layer, source) in (0..).zip(layers) {
        let mut target = whole.as_image_copy();
        target.origin.z = layer;
        encoder.copy_texture_to_texture(source.as_image_copy(), target, source.size());
    }
    gpu.queue.submit([encoder.finish()]);
    gpu.check()?;
    Ok(whole)
}

fn descriptor<'a>(
    label: &'a str,
    desc: &TextureDesc,
    usage: wgpu::TextureUsages,
) -> wgpu::TextureDescriptor<'a> {
    wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d {
            width: desc.size[0],
            height: desc.size[1],
            depth_or_array_layers: desc.array_layers(),
        },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: desc.wgpu_format(),
        usage,
        view_formats: &[],
    }
}
