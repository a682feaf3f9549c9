//! Panes of glass and a plume of smoke, and how they are drawn: what your renderer has for translucent things.

use glam::{DMat4, DVec3, Vec3};
use moment_shadows::BlendState;
use moment_shadows_graph::record::blend_state;

use crate::Frame;
use crate::renderer::{Matrix, Picture, Renderer};

/// A quad, as the shader has it.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct Quad {
    centre: [f32; 3],
    opacity: f32,
    right: [f32; 3],
    /// Whether it fades out from its middle on.
    soft: f32,
    up: [f32; 3],
    brightness: f32,
}

/// Three panes and a plume that rises, widens and thins.
fn quads() -> impl Iterator<Item = Quad> {
    let panes = (0..3).map(|index| Quad {
        centre: [-2.9 + 0.55 * index as f32, 0.9, 3.4 - 0.45 * index as f32],
        opacity: 0.35,
        right: [0.0, 0.0, 0.55],
        soft: 0.0,
        up: [0.0, 0.8, 0.0],
        brightness: 0.55,
    });
    // Puffs face the middle between sun and camera.
    let facing = Vec3::new(-0.32, 0.69, 0.65);
    let right = Vec3::Y.cross(facing).normalize();
    let up = facing.cross(right).normalize();
    let puffs = (0..28).map(move |index| {
        let height = index as f32 / 27.0;
        let (sine, cosine) = (2.4 * index as f32).sin_cos();
        let radius = 0.22 + 0.5 * height;
        let drift = Vec3::new(0.7 * height * height, 0.25 + 2.3 * height, 0.0);
        let centre = Vec3::new(0.7, 0.0, 3.3) + drift + 0.3 * height * Vec3::new(cosine, 0.0, sine);
        Quad {
            centre: centre.to_array(),
            opacity: 0.5 - 0.3 * height,
            right: (radius * right).to_array(),
            soft: 1.0,
            up: (radius * up).to_array(),
            brightness: 0.95,
        }
    });
    panes.chain(puffs)
}

/// The quads far to near from a view, whose depth may be reversed.
pub(crate) fn sorted(clip_from_world: &Matrix, reversed: bool) -> Vec<Quad> {
    let matrix = DMat4::from_cols_array_2d(clip_from_world);
    let depth = |quad: &Quad| {
        let depth = matrix
            .project_point3(DVec3::from(quad.centre.map(f64::from)))
            .z;
        if reversed { -depth } else { depth }
    };
    let mut quads: Vec<Quad> = quads().collect();
    quads.sort_by(|one, other| depth(other).total_cmp(&depth(one)));
    quads
}

/// A draw of all quads.
pub(crate) struct Draw {
    pipeline: wgpu::RenderPipeline,
    group: wgpu::BindGroup,
    count: u32,
}

impl Draw {
    /// Into the texture layers of the light's map, as the map says.
    pub(crate) fn into_map(
        yours: &Renderer,
        shader: &wgpu::ShaderModule,
        (map, blend): (&wgpu::Texture, &BlendState),
        frame: &Frame,
        quads: &[Quad],
        light_depth: &wgpu::Texture,
    ) -> Self {
        let target = wgpu::ColorTargetState {
            format: map.format(),
            blend: Some(blend_state(blend)),
            write_mask: wgpu::ColorWrites::ALL,
        };
        let targets = vec![Some(target); map.depth_or_array_layers() as usize];
        let pipeline = pipeline(yours, shader, "caster", &targets, false);
        let depth = light_depth.create_view(&Default::default());
        Self::new(yours, pipeline, frame, quads, (2, &depth))
    }

    /// Into the lit picture, behind what the camera sees in front.
    pub(crate) fn into_picture(
        yours: &Renderer,
        shader: &wgpu::ShaderModule,
        picture: &Picture,
        frame: &Frame,
        quads: &[Quad],
        map: &wgpu::Texture,
    ) -> Self {
        let target = wgpu::ColorTargetState {
            format: picture.lit_view().texture().format(),
            blend: Some(wgpu::BlendState::ALPHA_BLENDING),
            write_mask: wgpu::ColorWrites::COLOR,
        };
        let pipeline = pipeline(yours, shader, "seen", &[Some(target)], true);
        let map = map.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        Self::new(yours, pipeline, frame, quads, (3, &map))
    }

    fn new(
        yours: &Renderer,
        pipeline: wgpu::RenderPipeline,
        frame: &Frame,
        quads: &[Quad],
        (binding, texture): (u32, &wgpu::TextureView),
    ) -> Self {
        let frame = yours.uniform(bytemuck::bytes_of(frame));
        let quads_buffer = yours.storage(bytemuck::cast_slice(quads));
        let entries = [
            (0, frame.as_entire_binding()),
            (1, quads_buffer.as_entire_binding()),
            (binding, wgpu::BindingResource::TextureView(texture)),
        ];
        let entries = entries.map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource });
        let group = yours.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        });
        Self {
            pipeline,
            group,
            count: quads.len() as u32,
        }
    }

    /// Draws them to targets that keep what they hold, where the depth is nearer than the camera's if that is given.
    pub(crate) fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        targets: &[wgpu::TextureView],
        depth: Option<&wgpu::Texture>,
    ) {
        let targets: Vec<_> = targets.iter().map(kept).collect();
        let depth = depth.map(|depth| depth.create_view(&Default::default()));
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("translucent"),
            color_attachments: &targets,
            depth_stencil_attachment: depth.as_ref().map(|view| {
                // Read only.
                wgpu::RenderPassDepthStencilAttachment {
                    view,
                    depth_ops: None,
                    stencil_ops: None,
                }
            }),
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.group, &[]);
        pass.draw(0..4, 0..self.count);
    }
}

fn kept(view: &wgpu::TextureView) -> Option<wgpu::RenderPassColorAttachment<'_>> {
    Some(wgpu::RenderPassColorAttachment {
        view,
        depth_slice: None,
        resolve_target: None,
        ops: wgpu::Operations {
            load: wgpu::LoadOp::Load,
            store: wgpu::StoreOp::Store,
        },
    })
}

fn pipeline(
    yours: &Renderer,
    shader: &wgpu::ShaderModule,
    fragment: &str,
    targets: &[Option<wgpu::ColorTargetState>],
    tested: bool,
) -> wgpu::RenderPipeline {
    yours
        .device
        .create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(fragment),
            layout: None,
            vertex: wgpu::VertexState {
                module: shader,
                entry_point: Some("quad"),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState {
                topology: wgpu::PrimitiveTopology::TriangleStrip,
                ..Default::default()
            },
            depth_stencil: tested.then(|| wgpu::DepthStencilState {
                format: wgpu::TextureFormat::Depth32Float,
                depth_write_enabled: Some(false),
                depth_compare: Some(wgpu::CompareFunction::Greater),
                stencil: Default::default(),
                bias: Default::default(),
            }),
            multisample: Default::default(),
            fragment: Some(wgpu::FragmentState {
                module: shader,
                entry_point: Some(fragment),
                compilation_options: Default::default(),
                targets,
            }),
            multiview_mask: None,
            cache: None,
        })
}
