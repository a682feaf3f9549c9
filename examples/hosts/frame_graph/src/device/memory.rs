//! Textures and buffers of a plan.

use moment_shadows_graph::{Plan, PlannedResource, ResourceDesc};
use wgpu::{TextureUsages, TextureViewDimension};

use super::names::usage;
use super::recorder::draw;
use crate::error::HostError;
use crate::variants::stand_in;

/// The usages of a texture: those that passes need, those by which this host takes outputs, and that by which it fills.
pub fn texture_usage(plan: &Plan, index: usize) -> Result<TextureUsages, HostError> {
    let mut usages: TextureUsages = usage(&plan.resources[index].usage)?;
    if plan.outputs.iter().any(|output| output.value == index) {
        usages |= TextureUsages::COPY_SRC;
    }
    if stand_in(plan, index)?.is_some() {
        usages |= TextureUsages::RENDER_ATTACHMENT;
    }
    Ok(usages)
}

/// A buffer of the plan.
pub fn buffer(device: &wgpu::Device, of: &PlannedResource) -> Result<wgpu::Buffer, HostError> {
    let size = match of.desc {
        ResourceDesc::Buffer { size } => size,
        ResourceDesc::Texture(_) => 0,
    };
    Ok(device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(&of.name),
        size,
        usage: usage(&of.usage)?,
        mapped_at_creation: false,
    }))
}

/// Fills a texture with a texel for each plane.
pub fn fill(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    texture: &wgpu::Texture,
    texels: &[[f64; 4]],
) {
    let mut encoder = device.create_command_encoder(&Default::default());
    for layer in 0..texture.depth_or_array_layers() {
        let [r, g, b, a] = texels[layer as usize % texels.len()];
        for level in 0..texture.mip_level_count() {
            let view = texture.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(TextureViewDimension::D2),
                base_array_layer: layer,
                array_layer_count: Some(1),
                base_mip_level: level,
                mip_level_count: Some(1),
                ..Default::default()
            });
            let color = wgpu::Color { r, g, b, a };
            draw(&mut encoder, &view, wgpu::LoadOp::Clear(color));
        }
    }
    queue.submit([encoder.finish()]);
}
