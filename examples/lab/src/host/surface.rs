//! The G-buffer: what the camera sees, one sample per pixel.

use super::error::{check_size, created};
use super::model::{self, ViewUniform};
use super::{Model, Renderer, texture_2d};
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::view::Camera;

const POSITION: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;
const NORMAL: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;
const BASE_COLOUR: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

/// The textures of a G-buffer, all of one size. They may be bound; all but the depth may be copied.
pub struct Surface {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// The camera's depth, `Depth32Float`, reversed: 0 where nothing is seen.
    pub depth: wgpu::Texture,
    /// World position, `Rgba32Float`; w packs the shading normal and is 0 where nothing is seen.
    pub position: wgpu::Texture,
    /// Unit normal of the triangle itself, `Rgba16Float`, on the side that is seen: a leaf seen from behind has the
    /// normal of its back.
    pub normal: wgpu::Texture,
    /// Base colour, `Rgba8UnormSrgb`.
    pub base_colour: wgpu::Texture,
    views: [wgpu::TextureView; 4],
    uniform: wgpu::Buffer,
    group: wgpu::BindGroup,
}

impl Surface {
    /// Views of position, normal and base colour.
    pub(super) fn colour_views(&self) -> [&wgpu::TextureView; 3] {
        let [_, position, normal, base_colour] = &self.views;
        [position, normal, base_colour]
    }
}

/// The pipeline that fills a G-buffer.
pub(super) fn pipeline(
    device: &wgpu::Device,
    geometry: &wgpu::ShaderModule,
    layout: &wgpu::PipelineLayout,
) -> wgpu::RenderPipeline {
    let targets = [POSITION, NORMAL, BASE_COLOUR].map(|format| Some(format.into()));
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("host/surface"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module: geometry,
            entry_point: Some("place"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[Some(model::vertex_layout())],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: wgpu::TextureFormat::Depth32Float,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Greater),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: geometry,
            entry_point: Some("seen"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}

impl Renderer {
    /// An empty G-buffer.
    pub fn surface(&self, gpu: &Gpu, size: [u32; 2]) -> Result<Surface, LabError> {
        check_size(gpu, "the G-buffer", size)?;
        created(gpu, "the G-buffer", || {
            let drawn =
                wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING;
            let copied = drawn | wgpu::TextureUsages::COPY_SRC;
            let texture =
                |label, format, usage| texture_2d(&gpu.device, label, size, 1, format, usage);
            let depth = texture(
                "host/surface depth",
                wgpu::TextureFormat::Depth32Float,
                drawn,
            );
            let position = texture("host/surface position", POSITION, copied);
            let normal = texture("host/surface normal", NORMAL, copied);
            let base_colour = texture("host/surface base colour", BASE_COLOUR, copied);
            let views = [&depth, &position, &normal, &base_colour]
                .map(|texture| texture.create_view(&wgpu::TextureViewDescriptor::default()));
            let (uniform, group) = model::view_group(gpu, &self.view_layout, "host/surface");
            Surface {
                size,
                depth,
                position,
                normal,
                base_colour,
                views,
                uniform,
                group,
            }
        })
    }

    /// Records what `camera` sees of `model`. One surface takes one camera per submission: its uniforms are written
    /// through the queue.
    pub fn draw_surface(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        model: &Model,
        surface: &Surface,
        camera: &Camera,
    ) -> Result<(), LabError> {
        let uniform = ViewUniform {
            clip_from_world: camera.clip_from_world()?.as_mat4().to_cols_array_2d(),
            eye: camera.eye.as_vec3().to_array(),
            _padding: 0.0,
        };
        gpu.queue
            .write_buffer(&surface.uniform, 0, bytemuck::bytes_of(&uniform));
        let [depth, position, normal, base_colour] = &surface.views;
        let colours = [position, normal, base_colour].map(|view| {
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("host/surface"),
            color_attachments: &colours,
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: depth,
                depth_ops: Some(wgpu::Operations {
                    load: wgpu::LoadOp::Clear(0.0),
                    store: wgpu::StoreOp::Store,
                }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        let pipeline = &self.surface_pipeline;
        model.draw(&mut pass, &surface.group, pipeline, pipeline);
        Ok(())
    }
}
