//! Depth maps of lights and cameras: what the library takes.

use glam::DMat4;

use super::error::{check_size, created};
use super::model::{self, ViewUniform};
use super::{Model, Renderer, texture_2d};
use crate::error::LabError;
use crate::gpu::Gpu;

/// What kind of depth map is rendered into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DepthMapDesc {
    /// Width and height in texels.
    pub size: [u32; 2],
    /// Samples per texel: 1 and 4 everywhere, 2 and 8 where the device can.
    pub samples: u32,
    /// A depth format; of those with a stencil the depth is drawn.
    pub format: wgpu::TextureFormat,
    /// Whether depth is stored reversed: 1 at the near plane. As by the matrix that draws into it.
    pub reversed: bool,
}

/// A depth map, and what draws into it.
pub struct DepthMap {
    /// The depth texture: render attachment, texture binding, and copy source if it has one sample per texel and no stencil.
    pub texture: wgpu::Texture,
    /// A view of all of it.
    pub view: wgpu::TextureView,
    reversed: bool,
    opaque: wgpu::RenderPipeline,
    masked: wgpu::RenderPipeline,
    uniform: wgpu::Buffer,
    group: wgpu::BindGroup,
}

/// The sample counts that `format` has on this device.
fn supported_samples(gpu: &Gpu, format: wgpu::TextureFormat) -> Vec<u32> {
    let features = gpu.device.features();
    if features.contains(wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES) {
        let flags = gpu.adapter.get_texture_format_features(format).flags;
        [1, 2, 4, 8]
            .into_iter()
            .filter(|&count| flags.sample_count_supported(count))
            .collect()
    } else {
        // What WebGPU guarantees.
        vec![1, 4]
    }
}

impl Renderer {
    /// A depth map and its pipelines.
    pub fn depth_map(&self, gpu: &Gpu, desc: &DepthMapDesc) -> Result<DepthMap, LabError> {
        let format = desc.format;
        if !format.has_depth_aspect() {
            return Err(LabError::refused(format!(
                "depth cannot be rendered as {format:?}; use a depth format"
            )));
        }
        check_size(gpu, "the depth map", desc.size)?;
        let supported = supported_samples(gpu, format);
        if !supported.contains(&desc.samples) {
            return Err(LabError::refused(format!(
                "{format:?} with {} samples per texel is not supported by this device; it supports {supported:?}",
                desc.samples
            )));
        }
        let mut usage =
            wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
        if desc.samples == 1 && !format.is_combined_depth_stencil_format() {
            usage |= wgpu::TextureUsages::COPY_SRC;
        }
        created(gpu, "the depth map", || {
            let label = "host/depth";
            let texture = texture_2d(&gpu.device, label, desc.size, desc.samples, format, usage);
            let (uniform, group) = model::view_group(gpu, &self.view_layout, label);
            DepthMap {
                view: texture.create_view(&wgpu::TextureViewDescriptor::default()),
                texture,
                reversed: desc.reversed,
                opaque: self.depth_pipeline(gpu, desc, false),
                masked: self.depth_pipeline(gpu, desc, true),
                uniform,
                group,
            }
        })
    }

    fn depth_pipeline(&self, gpu: &Gpu, desc: &DepthMapDesc, masked: bool) -> wgpu::RenderPipeline {
        let fragment = wgpu::FragmentState {
            module: &self.geometry,
            entry_point: Some("depth_masked"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[],
        };
        gpu.device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("host/depth"),
                layout: Some(&self.geometry_layout),
                vertex: wgpu::VertexState {
                    module: &self.geometry,
                    entry_point: Some("place"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    buffers: &[Some(model::vertex_layout())],
                },
                // Nothing is culled: a leaf casts its shadow from either side.
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: Some(wgpu::DepthStencilState {
                    format: desc.format,
                    depth_write_enabled: Some(true),
                    depth_compare: Some(if desc.reversed {
                        wgpu::CompareFunction::Greater
                    } else {
                        wgpu::CompareFunction::Less
                    }),
                    stencil: wgpu::StencilState::default(),
                    bias: wgpu::DepthBiasState::default(),
                }),
                multisample: wgpu::MultisampleState {
                    count: desc.samples,
                    ..Default::default()
                },
                fragment: masked.then_some(fragment),
                multiview_mask: None,
                cache: None,
            })
    }

    /// Records the depth of `model`; texels that nothing covers hold the far plane. The matrix must store depth the way
    /// round that the map was made for. One map takes one matrix per submission: its uniforms are written through the
    /// queue.
    pub fn draw_depth(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        model: &Model,
        map: &DepthMap,
        clip_from_world: DMat4,
    ) {
        let uniform = ViewUniform {
            clip_from_world: clip_from_world.as_mat4().to_cols_array_2d(),
            eye: [0.0; 3],
            _padding: 0.0,
        };
        gpu.queue
            .write_buffer(&map.uniform, 0, bytemuck::bytes_of(&uniform));
        let far = if map.reversed { 0.0 } else { 1.0 };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("host/depth"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &map.view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(far),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        model.draw(&mut pass, &map.group, &map.opaque, &map.masked);
    }
}
