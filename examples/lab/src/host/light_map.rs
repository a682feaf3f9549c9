//! The light's depth: what the library takes.

use super::error::{check_size, created};
use super::model::{self, ViewUniform};
use super::{Model, Renderer, texture_2d};
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::light::LightView;

/// What kind of depth map a light is rendered into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LightMapDesc {
    /// Width and height in texels.
    pub size: [u32; 2],
    /// Samples per texel: 1 and 4 everywhere, 2 and 8 where the device can.
    pub samples: u32,
    /// A depth format; of those with a stencil the depth is drawn.
    pub format: wgpu::TextureFormat,
    /// Whether depth is stored reversed: 1 at the near plane. As in the light that is drawn into it.
    pub reversed: bool,
}

/// A depth map of a light, and what draws into it.
pub struct LightMap {
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
    pub fn light_map(&self, gpu: &Gpu, desc: &LightMapDesc) -> Result<LightMap, LabError> {
        let format = desc.format;
        if !format.has_depth_aspect() {
            return Err(LabError::refused(format!(
                "light depth cannot be rendered as {format:?}; use a depth format"
            )));
        }
        check_size(gpu, "the light's depth map", desc.size)?;
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
        created(gpu, "the light's depth map", || {
            let label = "host/light depth";
            let texture = texture_2d(&gpu.device, label, desc.size, desc.samples, format, usage);
            let (uniform, group) = model::view_group(gpu, &self.view_layout, label);
            LightMap {
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

    fn depth_pipeline(&self, gpu: &Gpu, desc: &LightMapDesc, masked: bool) -> wgpu::RenderPipeline {
        let fragment = wgpu::FragmentState {
            module: &self.geometry,
            entry_point: Some("depth_masked"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[],
        };
        gpu.device
            .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("host/light depth"),
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

    /// Records the light's depth of `model`; texels without a caster hold the far plane. `light` must store depth
    /// the way round that the map was made for. One map takes one light per submission: its uniforms are written
    /// through the queue.
    pub fn draw_light_depth(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        model: &Model,
        map: &LightMap,
        light: &LightView,
    ) {
        let uniform = ViewUniform {
            clip_from_world: light.clip_from_world().as_mat4().to_cols_array_2d(),
            eye: [0.0; 3],
            _padding: 0.0,
        };
        gpu.queue
            .write_buffer(&map.uniform, 0, bytemuck::bytes_of(&uniform));
        let far = if map.reversed { 0.0 } else { 1.0 };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("host/light depth"),
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
