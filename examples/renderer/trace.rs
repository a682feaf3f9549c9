//! The truth: a ray from each surface to the light.

use super::{Matrix, Renderer, pass};

impl Renderer {
    /// Writes the picture with shadows that are traced, to compare.
    pub(crate) fn save_traced(
        &self,
        camera: &Matrix,
        light: [f32; 4],
        size: [u32; 2],
        file: &str,
    ) -> Result<(), Box<dyn std::error::Error>> {
        let picture = self.picture(size);
        let traced = self.texture(size, 1, wgpu::TextureFormat::R8Unorm);
        let depth = self.texture(size, 1, wgpu::TextureFormat::Depth32Float);
        let mut encoder = self.device.create_command_encoder(&Default::default());
        self.draw_camera(&mut encoder, camera, light, &picture);
        let compare = Some(wgpu::CompareFunction::Greater);
        let formats = [traced.format()];
        let pipeline = self.pipeline(&self.shader, ["draw", "trace"], &formats, compare, 1);
        let frame = self.frame(camera, light);
        let resources = [frame.as_entire_binding(), self.boxes.as_entire_binding()];
        let group = self.group(&pipeline, 0, &resources);
        let cleared = [(&traced, wgpu::Color::BLACK)];
        let mut pass = pass(&mut encoder, &cleared, Some((&depth, 0.0)));
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &group, &[]);
        self.draw_boxes(&mut pass);
        drop(pass);
        self.light(&mut encoder, &picture, &traced, None);
        self.save(encoder, &picture, file)
    }
}
