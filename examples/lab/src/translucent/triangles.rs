//! A host that draws the translucent triangles of a scene, far to near from the light.

use glam::DVec3;
use moment_shadows::{MapEncoding, Opacity};

use super::draw::pipelines;
use super::host_pass::begin_on;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::host::{material_image, material_sampler};
use crate::light::LightView;
use crate::scene::Scene;

/// A vertex as `triangles.wgsl` takes it.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Vertex {
    place: [f32; 3],
    uv: [f32; 2],
    alpha: f32,
}

const ATTRIBUTES: [wgpu::VertexAttribute; 3] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x2, 2 => Float32];

const LAYOUT: wgpu::VertexBufferLayout<'_> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Vertex>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &ATTRIBUTES,
};

/// Pipelines and vertices of a scene's translucent triangles.
pub(super) struct Triangles {
    pipelines: Vec<wgpu::RenderPipeline>,
    vertices: wgpu::Buffer,
    /// Triangles of one material that are drawn at once: where they end, and a bind group for each pipeline.
    runs: Vec<(u32, Vec<wgpu::BindGroup>)>,
}

impl Triangles {
    /// Those that a light with parallel rays sees, where they lie in front of what is opaque in a texture of stored depth. They are sorted
    /// by their middles: where two meet, or one reaches far along another, their order is that of the whole.
    pub(super) fn new(
        gpu: &Gpu,
        (encoding, opacity): (&MapEncoding, Opacity),
        (scene, light): (&Scene, &LightView),
        opaque: &wgpu::Texture,
    ) -> Result<Self, LabError> {
        let text = (include_str!("triangles.wgsl"), "place");
        let pipelines = pipelines(gpu, encoding, opacity, text, &[Some(LAYOUT)])?;
        let sorted = sorted(scene, light);
        let vertices: Vec<Vertex> = sorted.iter().flat_map(|(_, corners)| *corners).collect();
        let opaque = opaque.create_view(&Default::default());
        let mut runs = Vec::new();
        let mut end = 0;
        for run in sorted.chunk_by(|one, other| one.0 == other.0) {
            end += 3 * run.len() as u32;
            let material = &scene.materials[run[0].0];
            let image = material_image(gpu, scene, material);
            let sampler = material_sampler(gpu, material);
            let groups = pipelines.iter().map(|pipeline| {
                let bound = [
                    wgpu::BindingResource::TextureView(&image),
                    wgpu::BindingResource::Sampler(&sampler),
                    wgpu::BindingResource::TextureView(&opaque),
                ];
                gpu.bind(&pipeline.get_bind_group_layout(0), bound)
            });
            runs.push((end, groups.collect()));
        }
        let bytes = bytemuck::cast_slice(&vertices);
        Ok(Self {
            vertices: gpu.filled("triangles", bytes, wgpu::BufferUsages::VERTEX),
            pipelines,
            runs,
        })
    }

    /// Draws them to all planes of a layer.
    pub(super) fn draw(&self, targets: &[wgpu::TextureView], encoder: &mut wgpu::CommandEncoder) {
        let mut drawn = begin_on(targets, "triangles", encoder);
        drawn.set_vertex_buffer(0, self.vertices.slice(..));
        let mut first = 0;
        for (end, groups) in &self.runs {
            // Both draws of one triangle come before those of the next.
            let at_once = if groups.len() > 1 { 3 } else { end - first };
            while first < *end {
                for (pipeline, group) in self.pipelines.iter().zip(groups) {
                    drawn.set_pipeline(pipeline);
                    drawn.set_bind_group(0, group, &[]);
                    drawn.draw(first..first + at_once, 0..1);
                }
                first += at_once;
            }
        }
    }
}

/// Material and corners of all translucent triangles, the farthest first.
fn sorted(scene: &Scene, light: &LightView) -> Vec<(usize, [Vertex; 3])> {
    let clip = light.clip_from_world();
    let mut all = Vec::new();
    for mesh in &scene.meshes {
        let Some(material) = scene.materials.get(mesh.material).filter(|it| it.blend) else {
            continue;
        };
        for corners in mesh.indices.as_chunks::<3>().0 {
            let corners = corners.map(|corner| {
                let corner = corner as usize;
                let position = DVec3::from_array(mesh.positions[corner].map(f64::from));
                let [x, y, _] = clip.project_point3(position).to_array();
                let depth = light.moment_depth(position);
                let alpha = mesh.alphas.get(corner).copied().unwrap_or(1.0);
                Vertex {
                    place: [x, y, depth].map(|it| it as f32),
                    uv: mesh.uvs[corner],
                    alpha: alpha * material.base_colour[3],
                }
            });
            all.push((mesh.material, corners));
        }
    }
    let middle =
        |(_, corners): &(usize, [Vertex; 3])| corners.map(|it| it.place[2]).iter().sum::<f32>();
    all.sort_by(|one, other| middle(other).total_cmp(&middle(one)));
    all
}
