//! A pass of a shader of the lab's own: a dispatch, or a triangle over a texture.

use crate::gpu::Gpu;

/// Something that is bound.
pub(crate) enum Bound<'a> {
    /// A uniform or storage buffer.
    Buffer(&'a wgpu::Buffer),
    /// A view of a texture.
    Texture(wgpu::TextureView),
    /// A sampler.
    Sampler(&'a wgpu::Sampler),
}

/// What a pass does, with the only entry point that its shader has for each stage.
pub(crate) enum Work {
    /// Dispatches so many workgroups.
    Dispatch([u32; 2]),
    /// Draws a triangle over a view, which was cleared.
    Draw(wgpu::TextureView),
}

/// A pass with everything that it binds.
pub(crate) struct Pass {
    pipeline: Pipeline,
    group: wgpu::BindGroup,
}

enum Pipeline {
    Dispatch(wgpu::ComputePipeline, [u32; 2]),
    Draw(wgpu::RenderPipeline, wgpu::TextureView),
}

impl Pass {
    /// Compiles a linked shader with values of its overridable constants, and binds group 0 of it by the numbers of its
    /// bindings. The device tells what is wrong: see [`Gpu::check`].
    pub(crate) fn new(
        gpu: &Gpu,
        label: &str,
        wgsl: String,
        constants: &[(&str, f64)],
        bound: &[(u32, Bound<'_>)],
        work: Work,
    ) -> Self {
        let (device, label) = (&gpu.device, Some(label));
        let module = &device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label,
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        });
        let compilation_options = wgpu::PipelineCompilationOptions {
            constants,
            ..Default::default()
        };
        let (pipeline, layout) = match work {
            Work::Dispatch(workgroups) => {
                let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                    label,
                    layout: None,
                    module,
                    entry_point: None,
                    compilation_options,
                    cache: None,
                });
                let layout = pipeline.get_bind_group_layout(0);
                (Pipeline::Dispatch(pipeline, workgroups), layout)
            }
            Work::Draw(target) => {
                let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                    label,
                    layout: None,
                    vertex: wgpu::VertexState {
                        module,
                        entry_point: None,
                        compilation_options: wgpu::PipelineCompilationOptions::default(),
                        buffers: &[],
                    },
                    primitive: wgpu::PrimitiveState::default(),
                    depth_stencil: None,
                    multisample: wgpu::MultisampleState::default(),
                    fragment: Some(wgpu::FragmentState {
                        module,
                        entry_point: None,
                        compilation_options,
                        targets: &[Some(target.texture().format().into())],
                    }),
                    multiview_mask: None,
                    cache: None,
                });
                let layout = pipeline.get_bind_group_layout(0);
                (Pipeline::Draw(pipeline, target), layout)
            }
        };
        let entries: Vec<_> = bound
            .iter()
            .map(|(binding, bound)| wgpu::BindGroupEntry {
                binding: *binding,
                resource: match bound {
                    Bound::Buffer(buffer) => buffer.as_entire_binding(),
                    Bound::Texture(view) => wgpu::BindingResource::TextureView(view),
                    Bound::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
                },
            })
            .collect();
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label,
            layout: &layout,
            entries: &entries,
        });
        Self { pipeline, group }
    }

    /// Records it.
    pub(crate) fn record(&self, encoder: &mut wgpu::CommandEncoder) {
        match &self.pipeline {
            Pipeline::Dispatch(pipeline, [columns, rows]) => {
                let mut pass = encoder.begin_compute_pass(&Default::default());
                pass.set_pipeline(pipeline);
                pass.set_bind_group(0, &self.group, &[]);
                pass.dispatch_workgroups(*columns, *rows, 1);
            }
            Pipeline::Draw(pipeline, view) => {
                let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                    color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                        view,
                        depth_slice: None,
                        resolve_target: None,
                        ops: wgpu::Operations {
                            load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
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
