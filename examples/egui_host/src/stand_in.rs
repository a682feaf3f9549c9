//! The lab's small renderer in place of an application's own: it draws the light's depth, the camera's depth and a picture
//! without shadows on egui's device, and knows where its camera and its light are.

use std::error::Error;

use eframe::egui_wgpu::RenderState;
use eframe::{egui, wgpu};
use moment_shadows::{CameraView, Kernel, LeakReduction, LightView, ReceiverBias, ViewParameters};
use moment_shadows_graph::Plan;
use moment_shadows_graph::record::ImportedResource;
use moment_shadows_lab::command::{drawn::Drawn, render::RenderOptions};
use moment_shadows_lab::{frame::Frame, gpu::Gpu, scene};

/// Why the example does not start.
pub type Failure = Box<dyn Error + Send + Sync>;

/// Width and height of the picture in pixels.
pub(crate) const SIZE: egui::Vec2 = egui::vec2(960.0, 540.0);

pub(crate) struct StandIn(Frame);

impl StandIn {
    pub(crate) fn new(egui: &RenderState) -> Result<Self, Failure> {
        let (device, queue) = (egui.device.clone(), egui.queue.clone());
        let gpu = Gpu::of_host(egui.adapter.clone(), device, queue);
        let options = RenderOptions::default();
        let drawn = Drawn {
            picture: [SIZE.x as u32, SIZE.y as u32],
            ..Drawn::default()
        };
        let scene = scene::load(&options.scene)?;
        Ok(Self(options.frame(&gpu, &scene, &drawn, 4)?))
    }

    /// What the graph takes from the host.
    pub(crate) fn imports(&self) -> [(&str, ImportedResource); 2] {
        let light = ImportedResource::from(&self.0.light_map.texture);
        let camera = ImportedResource::from(&self.0.surface.depth);
        [("light_depth", light), ("camera_depth", camera)]
    }

    /// The picture without shadows.
    pub(crate) fn picture(&self) -> wgpu::TextureView {
        let texture = &self.0.surface.base_colour;
        texture.create_view(&wgpu::TextureViewDescriptor::default())
    }

    /// Where camera and light are, as the plan's nodes take it. Written once, since nothing here moves.
    pub(crate) fn parameters(
        &self,
        egui: &RenderState,
        plan: &Plan,
    ) -> Result<wgpu::Buffer, Failure> {
        let desc = &self.0.desc;
        let kernel = Kernel::gaussian(4, 2.4)?;
        let light = LightView::orthographic(desc.light.clip_from_world().to_cols_array_2d());
        let camera = CameraView {
            clip_from_world: desc.camera.clip_from_world_columns()?,
            far_depth: 0.0,
        };
        let depth_per_texel = light.depth_per_texel(desc.map) as f32;
        let bias = ReceiverBias::for_kernel(kernel.standard_deviation(), depth_per_texel);
        let shade = ViewParameters::new(&camera, &light, bias, LeakReduction::DEFAULT)?;
        let mut block = plan.parameters.initial();
        let layout = &plan.parameters;
        layout.write(&mut block, "resolve", 0, &light.depth.conversion()?)?;
        layout.write(&mut block, "shade", 0, &shade)?;
        let buffer = egui.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("parameters of the view"),
            size: block.len() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        egui.queue.write_buffer(&buffer, 0, &block);
        Ok(buffer)
    }
}
