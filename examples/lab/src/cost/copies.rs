//! What passes are compared with: copies of textures to others of the same format and size.

use moment_shadows::TextureFormat;
use moment_shadows_graph::TextureDesc;

use super::CostError;
use super::protocol::Record;
use crate::gpu::Gpu;

/// Pairs of textures of one format and size, and the shaders that copy one of a pair to the other.
pub struct Copies {
    pairs: Vec<[wgpu::Texture; 2]>,
    layers: Vec<Layer>,
}

/// A layer of a texture that is copied.
struct Layer {
    group: wgpu::BindGroup,
    target: wgpu::TextureView,
    size: [u32; 2],
    pipeline: CopyPipeline,
}

#[derive(Clone)]
enum CopyPipeline {
    Compute(wgpu::ComputePipeline),
    Fullscreen(wgpu::RenderPipeline),
}

/// How the shader copies.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum CopyWork {
    /// A dispatch with a texel per invocation, in workgroups of 64 by 1.
    Compute,
    /// A triangle over the whole target: the baseline of passes that draw one, whose formats need not be storable.
    Fullscreen,
}

const WORKGROUP: u32 = 64;

impl Copies {
    /// Textures as described: all layers of the first mip level of each.
    pub fn new(gpu: &Gpu, descs: &[TextureDesc], work: CopyWork) -> Result<Self, CostError> {
        let mut copies = Self {
            pairs: Vec::new(),
            layers: Vec::new(),
        };
        for desc in descs {
            let format = desc.wgpu_format();
            let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
            copies.add(gpu, desc, format, work);
            if let Some(error) = pollster::block_on(scope.pop()) {
                return Err(CostError::Format {
                    format: desc.format,
                    reason: format!("a copy was refused: {error}"),
                });
            }
        }
        Ok(copies)
    }

    fn add(&mut self, gpu: &Gpu, desc: &TextureDesc, format: wgpu::TextureFormat, work: CopyWork) {
        let target = match work {
            CopyWork::Compute => wgpu::TextureUsages::STORAGE_BINDING,
            CopyWork::Fullscreen => wgpu::TextureUsages::RENDER_ATTACHMENT,
        };
        let pair = [
            wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC,
            target | wgpu::TextureUsages::COPY_DST,
        ]
        .map(|usage| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some("cost/copy"),
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
        });
        let pipeline = CopyPipeline::new(gpu, desc.format, format, work);
        // A fullscreen copy has its target as an attachment.
        let (layout, bound) = match &pipeline {
            CopyPipeline::Compute(pipeline) => (pipeline.get_bind_group_layout(0), 2),
            CopyPipeline::Fullscreen(pipeline) => (pipeline.get_bind_group_layout(0), 1),
        };
        for layer in 0..desc.layers {
            let [source, target] = [0, 1].map(|end: usize| {
                pair[end].create_view(&wgpu::TextureViewDescriptor {
                    dimension: Some(wgpu::TextureViewDimension::D2),
                    base_array_layer: layer,
                    array_layer_count: Some(1),
                    ..Default::default()
                })
            });
            let entries =
                [(0, &source), (1, &target)].map(|(binding, view)| wgpu::BindGroupEntry {
                    binding,
                    resource: wgpu::BindingResource::TextureView(view),
                });
            let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("cost/copy"),
                layout: &layout,
                entries: &entries[..bound],
            });
            self.layers.push(Layer {
                group,
                target,
                size: desc.size,
                pipeline: pipeline.clone(),
            });
        }
        self.pairs.push(pair);
    }

    /// The copy by a shader: the unit of all costs.
    pub fn by_shader(&self) -> Record<'_> {
        Box::new(|encoder| {
            self.layers.iter().for_each(|layer| layer.record(encoder));
            Ok(())
        })
    }

    /// The copy by the interface: on a graphics processor the fastest there is, on a software adapter a memcpy.
    pub fn by_interface(&self) -> Record<'_> {
        Box::new(|encoder| {
            for [from, to] in &self.pairs {
                let (from, to, size) = (from.as_image_copy(), to.as_image_copy(), to.size());
                encoder.copy_texture_to_texture(from, to, size);
            }
            Ok(())
        })
    }
}

impl Layer {
    fn record(&self, encoder: &mut wgpu::CommandEncoder) {
        match &self.pipeline {
            CopyPipeline::Compute(pipeline) => {
                let mut pass = encoder.begin_compute_pass(&Default::default());
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &self.group, &[]);
                pass.dispatch_workgroups(self.size[0].div_ceil(WORKGROUP), self.size[1], 1);
            }
            CopyPipeline::Fullscreen(pipeline) => {
                let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                    color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                        view: &self.target,
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
                pass.set_bind_group(0, &self.group, &[]);
                pass.draw(0..3, 0..1);
            }
        }
    }
}

impl CopyPipeline {
    fn new(gpu: &Gpu, texel: TextureFormat, format: wgpu::TextureFormat, work: CopyWork) -> Self {
        let (device, label) = (&gpu.device, Some("cost/copy"));
        let module = &device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label,
            source: wgpu::ShaderSource::Wgsl(shader(work, texel).into()),
        });
        let compilation_options = wgpu::PipelineCompilationOptions::default();
        match work {
            CopyWork::Compute => CopyPipeline::Compute(device.create_compute_pipeline(
                &wgpu::ComputePipelineDescriptor {
                    label,
                    layout: None,
                    module,
                    entry_point: Some("copy"),
                    compilation_options,
                    cache: None,
                },
            )),
            CopyWork::Fullscreen => CopyPipeline::Fullscreen(device.create_render_pipeline(
                &wgpu::RenderPipelineDescriptor {
                    label,
                    layout: None,
                    vertex: wgpu::VertexState {
                        module,
                        entry_point: Some("fullscreen"),
                        compilation_options: compilation_options.clone(),
                        buffers: &[],
                    },
                    primitive: wgpu::PrimitiveState::default(),
                    depth_stencil: None,
                    multisample: wgpu::MultisampleState::default(),
                    fragment: Some(wgpu::FragmentState {
                        module,
                        entry_point: Some("copy"),
                        compilation_options,
                        targets: &[Some(format.into())],
                    }),
                    multiview_mask: None,
                    cache: None,
                },
            )),
        }
    }
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

/// A texture of as many bytes that a shader can store to everywhere: the same one, unless its texels are too small.
pub(super) fn storable(desc: &TextureDesc) -> TextureDesc {
    match desc.format {
        TextureFormat::R8Unorm | TextureFormat::R16Float => {
            let row = desc.size[0] * desc.format.bytes_per_texel();
            TextureDesc {
                layers: desc.layers,
                ..TextureDesc::new(TextureFormat::R32Float, [row.div_ceil(4), desc.size[1]])
            }
        }
        _ => desc.clone(),
    }
}
