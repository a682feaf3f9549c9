//! One frame of the reference host: a scene seen by a camera and a light, drawn, ready for a graph.

use glam::{DMat4, DVec3};

use crate::error::LabError;
use crate::gpu::Gpu;
use crate::host::{DepthMap, DepthMapDesc, Lighting, Model, Renderer, Surface};
use crate::light::{LightShape, LightView};
use crate::scene::Scene;
use crate::truth::surface::MomentDepths;
use crate::view::Camera;

/// What is drawn, and how large.
#[derive(Clone, Copy, Debug)]
pub struct FrameDesc {
    /// Width and height of the picture.
    pub picture: [u32; 2],
    /// Width and height of the light's depth map.
    pub map: [u32; 2],
    /// Samples per texel of the light's depth map.
    pub samples: u32,
    /// The format of the light's depth map.
    pub format: wgpu::TextureFormat,
    /// Format and samples per pixel of the camera's depth. Truths are of pixels' middles.
    pub camera_depth: (wgpu::TextureFormat, u32),
    /// The light.
    pub light: LightView,
    /// How large the light is, for techniques that make soft shadows.
    pub shape: LightShape,
    /// The camera.
    pub camera: Camera,
}

/// A drawn frame.
pub struct Frame {
    /// What it was drawn from.
    pub desc: FrameDesc,
    /// The light's depth.
    pub light_map: DepthMap,
    /// The camera's G-buffer.
    pub surface: Surface,
    /// The camera's depth, where it is another than the surface's.
    camera_map: Option<DepthMap>,
    renderer: Renderer,
    model: Model,
    lighting: Lighting,
}

impl Frame {
    /// Draws the light's depth and the G-buffer of a scene, and waits for the device's verdict.
    pub fn draw(gpu: &Gpu, scene: &Scene, desc: FrameDesc) -> Result<Self, LabError> {
        let renderer = Renderer::new(gpu)?;
        let model = renderer.upload(gpu, scene)?;
        let light_map = renderer.depth_map(
            gpu,
            &DepthMapDesc {
                size: desc.map,
                samples: desc.samples,
                format: desc.format,
                reversed: desc.light.depth.reversed(),
            },
        )?;
        let surface = renderer.surface(gpu, desc.picture)?;
        let (format, samples) = desc.camera_depth;
        let other = (format, samples) != (surface.depth.format(), 1);
        let camera_map = DepthMapDesc {
            size: desc.picture,
            samples,
            format,
            reversed: true,
        };
        let camera_map = other
            .then(|| renderer.depth_map(gpu, &camera_map))
            .transpose()?;
        let mut frame = Self {
            lighting: Lighting::new(scene, &desc.camera, &desc.light)?,
            desc,
            light_map,
            surface,
            camera_map,
            renderer,
            model,
        };
        frame.redraw(gpu, scene, desc)?;
        Ok(frame)
    }

    /// Draws the same with as many samples per texel of the light's map, and with one.
    pub fn pair(gpu: &Gpu, scene: &Scene, desc: FrameDesc) -> Result<[Self; 2], LabError> {
        let plain = FrameDesc { samples: 1, ..desc };
        Ok([
            Self::draw(gpu, scene, desc)?,
            Self::draw(gpu, scene, plain)?,
        ])
    }

    /// The camera's depth.
    #[must_use]
    pub fn camera_depth(&self) -> &wgpu::Texture {
        let map = self.camera_map.as_ref();
        map.map_or(&self.surface.depth, |map| &map.texture)
    }

    /// Draws it again with another light and camera, all of the same sizes.
    pub fn redraw(&mut self, gpu: &Gpu, scene: &Scene, desc: FrameDesc) -> Result<(), LabError> {
        let mut encoder = gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor {
                label: Some("lab/frame"),
            });
        let (renderer, model) = (&self.renderer, &self.model);
        let light = desc.light.clip_from_world();
        renderer.draw_depth(gpu, &mut encoder, model, &self.light_map, light);
        if let Some(map) = &self.camera_map {
            let camera = desc.camera.clip_from_world()?;
            renderer.draw_depth(gpu, &mut encoder, model, map, camera);
        }
        renderer.draw_surface(gpu, &mut encoder, model, &self.surface, &desc.camera)?;
        gpu.queue.submit([encoder.finish()]);
        gpu.check()?;
        self.lighting = Lighting::new(scene, &desc.camera, &desc.light)?;
        self.desc = desc;
        Ok(())
    }

    /// The light's depth at any number of places within each texel, as truths read it: whatever the light's map has, they see the
    /// same.
    pub fn light_samples(
        &self,
        gpu: &Gpu,
        positions: &[[f64; 2]],
    ) -> Result<MomentDepths, LabError> {
        let (light, size) = (&self.desc.light, self.desc.map);
        let map = self.renderer.depth_map(
            gpu,
            &DepthMapDesc {
                size,
                samples: 1,
                format: wgpu::TextureFormat::Depth32Float,
                reversed: light.depth.reversed(),
            },
        )?;
        MomentDepths::from_maps(light, size, positions, |position| {
            // What lies there moves to the texel's middle, where a map has its sample.
            let [right, up] = [position[0] - 0.5, 0.5 - position[1]];
            let moved = DVec3::new(
                -2.0 * right / f64::from(size[0]),
                -2.0 * up / f64::from(size[1]),
                0.0,
            );
            let clip = DMat4::from_translation(moved) * light.clip_from_world();
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            self.renderer
                .draw_depth(gpu, &mut encoder, &self.model, &map, clip);
            gpu.queue.submit([encoder.finish()]);
            let bytes = gpu.read_texture(&map.texture, 0, "light samples")?;
            Ok(bytemuck::pod_collect_to_vec(&bytes))
        })
    }

    /// The picture, as sRGB bytes with alpha, for a texture of shadow intensity.
    pub fn picture(&self, gpu: &Gpu, shadow: &wgpu::Texture) -> Result<Vec<u8>, LabError> {
        let mut encoder = gpu
            .device
            .create_command_encoder(&wgpu::CommandEncoderDescriptor {
                label: Some("lab/picture"),
            });
        let view = shadow.create_view(&wgpu::TextureViewDescriptor::default());
        let picture =
            self.renderer
                .shade(gpu, &mut encoder, &self.surface, &view, &self.lighting)?;
        gpu.queue.submit([encoder.finish()]);
        gpu.read_texture(&picture, 0, "picture")
    }
}
