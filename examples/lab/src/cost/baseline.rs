//! What passes are compared with: copies of one texture to another of the same format.

use moment_shadows::TextureFormat;
use moment_shadows_graph::TextureDesc;
use moment_shadows_graph::record::texture_format;

use super::CostError;
use super::protocol::Record;
use crate::gpu::Gpu;

/// Two textures of one format and size, and the shader that copies one to the other.
pub struct Copies {
    from: wgpu::Texture,
    to: wgpu::Texture,
    /// Per layer.
    layers: Vec<Layer>,
    pipeline: CopyPipeline,
}

struct Layer {
    group: wgpu::BindGroup,
    target: wgpu::TextureView,
}

enum CopyPipeline {
    Compute(wgpu::ComputePipeline),
    Fullscreen(wgpu::RenderPipeline),
}

/// How the shader copies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CopyWork {
    /// A dispatch with a texel per invocation, in workgroups of 64 by 1.
    Compute,
    /// A triangle over the whole target: the baseline of passes that draw one, whose formats need not be storable.
    Fullscreen,
}

const WORKGROUP: u32 = 64;

impl Copies {
    /// Textures as `desc` says: all layers of its first mip level.
    pub fn new(gpu: &Gpu, desc: &TextureDesc, work: CopyWork) -> Result<Self, CostError> {
        let refused = |reason: String| CostError::Baseline {
            format: desc.format,
            reason,
        };
        let format = texture_format(desc.format)
            .ok_or_else(|| refused("the recorder does not know it".to_owned()))?;
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let copies = Self::create(gpu, desc, format, work);
        match pollster::block_on(scope.pop()) {
            None => Ok(copies),
            Some(error) => Err(refused(error.to_string())),
        }
    }

    fn create(gpu: &Gpu, desc: &TextureDesc, format: wgpu::TextureFormat, work: CopyWork) -> Self {
        let device = &gpu.device;
        let target = match work {
            CopyWork::Compute => wgpu::TextureUsages::STORAGE_BINDING,
            CopyWork::Fullscreen => wgpu::TextureUsages::RENDER_ATTACHMENT,
        };
        let texture = |label, usage| {
            device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: wgpu::Extent3d {
                    width: desc.size[0],
                    height: desc.size[1],
                    depth_or_array_layers: desc.layers,
                },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            })
        };
        let from = texture(
            "cost/copy from",
            wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC,
        );
        let to = texture("cost/copy to", target | wgpu::TextureUsages::COPY_DST);
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("cost/copy"),
            source: wgpu::ShaderSource::Wgsl(shader(work, desc.format).into()),
        });
        let pipeline = match work {
            CopyWork::Compute => CopyPipeline::Compute(device.create_compute_pipeline(
                &wgpu::ComputePipelineDescriptor {
                    label: Some("cost/copy"),
                    layout: None,
                    module: &module,
                    entry_point: Some("copy"),
                    compilation_options: wgpu::PipelineCompilationOptions::default(),
                    cache: None,
                },
            )),
            CopyWork::Fullscreen => CopyPipeline::Fullscreen(device.create_render_pipeline(
                &wgpu::RenderPipelineDescriptor {
                    label: Some("cost/copy"),
                    layout: None,
                    vertex: wgpu::VertexState {
                        module: &module,
                        entry_point: Some("fullscreen"),
                        compilation_options: wgpu::PipelineCompilationOptions::default(),
                        buffers: &[],
                    },
                    primitive: wgpu::PrimitiveState::default(),
                    depth_stencil: None,
                    multisample: wgpu::MultisampleState::default(),
                    fragment: Some(wgpu::FragmentState {
                        module: &module,
                        entry_point: Some("copy"),
                        compilation_options: wgpu::PipelineCompilationOptions::default(),
                        targets: &[Some(format.into())],
                    }),
                    multiview_mask: None,
                    cache: None,
                },
            )),
        };
        let layout = match &pipeline {
            CopyPipeline::Compute(pipeline) => pipeline.get_bind_group_layout(0),
            CopyPipeline::Fullscreen(pipeline) => pipeline.get_bind_group_layout(0),
        };
        let layers = (0..desc.layers)
            .map(|layer| {
                let [source, target] = [&from, &to].map(|texture| one_layer(texture, layer));
                let entry = |binding, view| wgpu::BindGroupEntry {
                    binding,
                    resource: wgpu::BindingResource::TextureView(view),
                };
                let entries = [entry(0, &source), entry(1, &target)];
                // A fullscreen copy has its target as an attachment.
                let bound = match work {
                    CopyWork::Compute => 2,
                    CopyWork::Fullscreen => 1,
                };
                let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
                    label: Some("cost/copy"),
                    layout: &layout,
                    entries: &entries[..bound],
                });
                Layer { group, target }
            })
            .collect();
        Self {
            from,
            to,
            layers,
            pipeline,
        }
    }

    /// The copy by a shader: the unit of all costs.
    pub fn by_shader(&self) -> Record<'_> {
        Box::new(|encoder| {
            for layer in &self.layers {
                self.record_layer(encoder, layer);
            }
            Ok(())
        })
    }

    fn record_layer(&self, encoder: &mut wgpu::CommandEncoder, layer: &Layer) {
        match &self.pipeline {
            CopyPipeline::Compute(pipeline) => {
                let mut pass = encoder.begin_compute_pass(&Default::default());
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &layer.group, &[]);
                let columns = self.to.width().div_ceil(WORKGROUP);
                pass.dispatch_workgroups(columns, self.to.height(), 1);
            }
            CopyPipeline::Fullscreen(pipeline) => {
                let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                    color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                        view: &layer.target,
                        depth_slice: None,
                        resolve_target: None,
                        ops: wgpu::Operations {
                            load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                            store: wgpu::StoreOp::Store,
                        },
                    })],
                    ..Default::default()
                });
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &layer.group, &[]);
                pass.draw(0..3, 0..1);
            }
        }
    }

    /// The copy by the interface: on a graphics processor the fastest there is, on a software adapter a memcpy.
    pub fn by_interface(&self) -> Record<'_> {
        Box::new(|encoder| {
            encoder.copy_texture_to_texture(
                self.from.as_image_copy(),
                self.to.as_image_copy(),
                self.to.size(),
            );
            Ok(())
        })
    }
}

fn one_layer(texture: &wgpu::Texture, layer: u32) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor {
        dimension: Some(wgpu::TextureViewDimension::D2),
        base_array_layer: layer,
        array_layer_count: Some(1),
        ..Default::default()
    })
}

fn shader(work: CopyWork, format: TextureFormat) -> String {
    let texel = if format.is_integer() { "u32" } else { "f32" };
    match work {
        CopyWork::Compute => format!(
            "@group(0) @binding(0) var copied: texture_2d<{texel}>;
@group(0) @binding(1) var copy_target: texture_storage_2d<{format}, write>;
@compute @workgroup_size({WORKGROUP}, 1)
fn copy(@builtin(global_invocation_id) id: vec3u) {{
    if all(id.xy < textureDimensions(copy_target)) {{
        textureStore(copy_target, id.xy, textureLoad(copied, id.xy, 0));
    }}
}}
"
        ),
        CopyWork::Fullscreen => "@group(0) @binding(0) var copied: texture_2d<f32>;
@vertex
fn fullscreen(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    return vec4f(vec2f(vec2u(vertex & 1u, vertex >> 1u)) * 4.0 - 1.0, 0.0, 1.0);
}
@fragment
fn copy(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return textureLoad(copied, vec2i(position.xy), 0);
}
"
        .to_owned(),
    }
}
