//! The picture: base colour, light, shadow intensity.

use glam::{DMat3, DVec3};

use super::error::created;
use super::{Renderer, Surface, texture_2d};
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::light::{LightKind, LightView};
use crate::scene::Scene;
use crate::view::Camera;

/// `Lighting` of `shade.wgsl`: a warm sun, a cool sky, a light horizon.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Lighting {
    direction_from_ndc: [[f32; 4]; 4],
    light: [f32; 4],
    cone: [f32; 4],
    /// Linear colour of the light, its intensity included; w is unused.
    pub colour: [f32; 4],
    /// Linear colour of what comes from above; w is unused.
    pub sky: [f32; 4],
    /// Linear colour of what comes from below; w is unused.
    pub ground: [f32; 4],
    /// Linear colour of the horizon; w: where the ground begins to fade into it, as a distance from the origin.
    pub horizon: [f32; 4],
    /// Linear colour of the background far above the horizon; w is unused.
    pub zenith: [f32; 4],
}

impl Lighting {
    /// The usual look for `light`, seen by `camera`.
    pub fn new(scene: &Scene, camera: &Camera, light: &LightView) -> Result<Self, LabError> {
        let world_from_light = light.view_from_world.inverse();
        let towards = light.towards_light(DVec3::ZERO);
        let axis = -world_from_light.transform_vector3(DVec3::Z);
        let (direction, point) = match light.kind() {
            LightKind::Directional => (towards, 0.0),
            LightKind::Spot => (world_from_light.transform_point3(DVec3::ZERO), 1.0),
        };
        // The map's square holds the cone whose edge touches the middle of its sides.
        let cosine = light.clip_from_view.x_axis.x.atan2(1.0).sin();
        // A view direction from normalised device coordinates: (x tan, y tan, -1) turned into world space.
        let tangent = (0.5 * camera.vertical_angle).tan();
        let world_from_camera = DMat3::from_mat4(camera.view_from_world()?.inverse());
        let to_world = world_from_camera
            * DMat3::from_diagonal(DVec3::new(tangent * camera.aspect, tangent, -1.0));
        let column = |v: DVec3, w: f32| {
            let [x, y, z] = v.as_vec3().to_array();
            [x, y, z, w]
        };
        Ok(Self {
            direction_from_ndc: [
                column(to_world.x_axis, 0.0),
                column(to_world.y_axis, 0.0),
                column(to_world.z_axis, 0.0),
                [0.0; 4],
            ],
            light: column(direction, point),
            cone: column(axis, cosine as f32),
            colour: [2.4, 2.2, 1.9, 0.0],
            sky: [0.34, 0.38, 0.46, 0.0],
            ground: [0.22, 0.205, 0.19, 0.0],
            horizon: [0.85, 0.87, 0.9, (7.0 * scene.bounds().radius()) as f32],
            zenith: [0.36, 0.48, 0.66, 0.0],
        })
    }
}

/// The pipeline that makes the picture.
pub(super) fn pipeline(device: &wgpu::Device) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::include_wgsl!("shade.wgsl"));
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("host/shade"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("cover"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: None,
        multisample: wgpu::MultisampleState::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("shade"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(wgpu::TextureFormat::Rgba8UnormSrgb.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}

impl Renderer {
    /// Records the picture: `shadow` holds the shadow intensity of each pixel of `surface` in its first channel, in
    /// any float or normalised format, at the surface's size. The result is `Rgba8UnormSrgb` and may be copied.
    pub fn shade(
        &self,
        gpu: &Gpu,
        encoder: &mut wgpu::CommandEncoder,
        surface: &Surface,
        shadow: &wgpu::TextureView,
        lighting: &Lighting,
    ) -> Result<wgpu::Texture, LabError> {
        let shadow_size = [shadow.texture().width(), shadow.texture().height()];
        if shadow_size != surface.size {
            let [[width, height], [own_width, own_height]] = [shadow_size, surface.size];
            return Err(LabError::refused(format!(
                "the shadow intensity has {width}x{height} texels and the G-buffer {own_width}x{own_height}; render it at the \
                 G-buffer's size"
            )));
        }
        let (picture, group) = created(gpu, "the picture", || {
            let picture = texture_2d(
                &gpu.device,
                "host/picture",
                surface.size,
                1,
                wgpu::TextureFormat::Rgba8UnormSrgb,
                wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            );
            let uniform = gpu.filled(
                "host/lighting",
                bytemuck::bytes_of(lighting),
                wgpu::BufferUsages::UNIFORM,
            );
            let [position, normal, base_colour] = surface.colour_views();
            let textures = [position, normal, base_colour, shadow];
            let textures = textures.map(wgpu::BindingResource::TextureView);
            let group = gpu.bind(
                &self.shade_pipeline.get_bind_group_layout(0),
                [uniform.as_entire_binding()].into_iter().chain(textures),
            );
            (picture, group)
        })?;
        let view = picture.create_view(&wgpu::TextureViewDescriptor::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("host/shade"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                    store: wgpu::StoreOp::Store,
                },
            })],
            ..Default::default()
        });
        pass.set_pipeline(&self.shade_pipeline);
        pass.set_bind_group(0, &group, &[]);
        pass.draw(0..3, 0..1);
        drop(pass);
        Ok(picture)
    }
}
