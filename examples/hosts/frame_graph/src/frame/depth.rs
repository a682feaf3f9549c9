//! The host's pass that draws a depth map.

use moment_shadows_graph::TextureDesc;
use nightshade_renderer::rendergraph::{self, PassExecutionContext, PassNode, SubGraphRunCommand};

use crate::adapter::Inputs;
use crate::device::by_name;
use crate::error::HostError;
use crate::gpu::Gpu;

pub(super) struct DrawDepth {
    name: String,
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
    pub(super) depths: wgpu::Buffer,
}

impl DrawDepth {
    pub(super) fn new(gpu: &Gpu, name: String, of: &TextureDesc) -> Result<Self, HostError> {
        let device = &gpu.device;
        let module = device.create_shader_module(wgpu::include_wgsl!("depth.wgsl"));
        let constants = [
            ("width", f64::from(of.size[0])),
            ("samples", f64::from(of.samples)),
        ];
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("depth"),
            layout: None,
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("triangle"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("depth"),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: &constants,
                    ..Default::default()
                },
                targets: &[],
            }),
            primitive: Default::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: by_name(of.format)?,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Always),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: wgpu::MultisampleState {
                count: of.samples,
                ..Default::default()
            },
            multiview_mask: None,
            cache: None,
        });
        let depths = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("depths"),
            size: u64::from(of.size[0] * of.size[1] * of.samples) * 4,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: depths.as_entire_binding(),
            }],
        });
        Ok(Self {
            name,
            pipeline,
            group,
            depths,
        })
    }
}

impl PassNode<Inputs> for DrawDepth {
    fn name(&self) -> &str {
        &self.name
    }

    fn reads(&self) -> Vec<&str> {
        Vec::new()
    }

    fn writes(&self) -> Vec<&str> {
        vec!["depth"]
    }

    fn execute<'r, 'e>(
        &mut self,
        context: PassExecutionContext<'r, 'e, Inputs>,
    ) -> rendergraph::Result<Vec<SubGraphRunCommand<'r>>> {
        let (view, ..) = context.get_depth_attachment("depth")?;
        let mut pass = context
            .encoder
            .begin_render_pass(&wgpu::RenderPassDescriptor {
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view,
                    depth_ops: Some(wgpu::Operations {
                        load: wgpu::LoadOp::Clear(0.0),
                        store: wgpu::StoreOp::Store,
                    }),
                    stencil_ops: None,
                }),
                ..Default::default()
            });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.draw(0..3, 0..1);
        Ok(Vec::new())
    }
}
