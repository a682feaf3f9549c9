//! What draws in a host's pass: pipelines that blend into a map, and the pass itself, which keeps what the map holds.

use moment_shadows_graph::record::HostPass;

use crate::gpu::Gpu;

/// A pipeline that blends into all planes of a map.
pub fn blending(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    [vertex, fragment]: [&str; 2],
    buffers: &[Option<wgpu::VertexBufferLayout<'_>>],
    (format, blend, planes): (wgpu::TextureFormat, wgpu::BlendState, usize),
) -> wgpu::RenderPipeline {
    let target = wgpu::ColorTargetState {
        format,
        blend: Some(blend),
        write_mask: wgpu::ColorWrites::ALL,
    };
    gpu.device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(fragment),
            layout: None,
            vertex: wgpu::VertexState {
                module,
                entry_point: Some(vertex),
                compilation_options: Default::default(),
                buffers,
            },
            primitive: Default::default(),
            depth_stencil: None,
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module,
                entry_point: Some(fragment),
                compilation_options: Default::default(),
                targets: &vec![Some(target); planes],
            }),
            multiview_mask: None,
            cache: None,
        })
}

/// Begins to draw to the targets of a host's pass.
pub fn begin<'encoder>(
    pass: &HostPass<'_>,
    encoder: &'encoder mut wgpu::CommandEncoder,
) -> wgpu::RenderPass<'encoder> {
    begin_on(pass.targets, pass.name, encoder)
}

/// Begins to draw to all planes of a layer.
pub(super) fn begin_on<'encoder>(
    targets: &[wgpu::TextureView],
    label: &str,
    encoder: &'encoder mut wgpu::CommandEncoder,
) -> wgpu::RenderPass<'encoder> {
    let attachment = |view| {
        Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations {
                load: wgpu::LoadOp::Load,
                store: wgpu::StoreOp::Store,
            },
        })
    };
    let attachments: Vec<_> = targets.iter().map(attachment).collect();
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: &attachments,
        ..Default::default()
    })
}
