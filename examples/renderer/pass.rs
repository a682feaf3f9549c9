//! Render passes.

/// A render pass that clears its targets.
pub(crate) fn pass<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    colours: &[(&wgpu::Texture, wgpu::Color)],
    depth: Option<(&wgpu::Texture, f32)>,
) -> wgpu::RenderPass<'a> {
    let view = |texture: &wgpu::Texture| texture.create_view(&Default::default());
    let colours: Vec<_> = colours
        .iter()
        .map(|(colour, clear)| (view(colour), *clear))
        .collect();
    let attachments: Vec<_> = colours
        .iter()
        .map(|(view, clear)| {
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(*clear),
                    store: wgpu::StoreOp::Store,
                },
            })
        })
        .collect();
    let depth = depth.map(|(depth, far)| (view(depth), far));
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: None,
        color_attachments: &attachments,
        depth_stencil_attachment: depth.as_ref().map(|(view, far)| {
            wgpu::RenderPassDepthStencilAttachment {
                view,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(*far),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }
        }),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}
