//! A scene in the device's memory.

use wgpu::util::DeviceExt;

use super::Renderer;
use super::error::created;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::scene::{Image, Material, Scene, mips};

/// A scene in the device's memory, ready to be drawn.
pub struct Model {
    parts: Vec<Part>,
}

/// The meshes of one material, as one draw.
struct Part {
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    count: u32,
    material: wgpu::BindGroup,
    masked: bool,
}

/// A vertex as the shader takes it.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Vertex {
    position: [f32; 3],
    normal: [f32; 3],
    uv: [f32; 2],
    alpha: f32,
}

/// `Surface` of `geometry.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct SurfaceUniform {
    base_colour: [f32; 4],
    mask: f32,
    _padding: [f32; 3],
}

/// `View` of `geometry.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct ViewUniform {
    pub(super) clip_from_world: [[f32; 4]; 4],
    pub(super) eye: [f32; 3],
    pub(super) _padding: f32,
}

/// Attributes of [`Vertex`].
const ATTRIBUTES: [wgpu::VertexAttribute; 4] =
    wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x2, 3 => Float32];

/// How pipelines read [`Vertex`].
pub(super) fn vertex_layout() -> wgpu::VertexBufferLayout<'static> {
    wgpu::VertexBufferLayout {
        array_stride: size_of::<Vertex>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &ATTRIBUTES,
    }
}

/// A group of `geometry.wgsl`, for its bindings 0, 1, ...: the view, or a material.
fn layout<const COUNT: usize>(
    device: &wgpu::Device,
    visibility: wgpu::ShaderStages,
    types: [wgpu::BindingType; COUNT],
) -> wgpu::BindGroupLayout {
    let entries: Vec<_> = (0..)
        .zip(types)
        .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility,
            ty,
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("host/geometry"),
        entries: &entries,
    })
}

/// Groups 0 and 1 of `geometry.wgsl`: the view and the material.
pub(super) fn layouts(device: &wgpu::Device) -> [wgpu::BindGroupLayout; 2] {
    let uniform = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let texture = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: true },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
    [
        layout(device, wgpu::ShaderStages::VERTEX_FRAGMENT, [uniform]),
        layout(
            device,
            wgpu::ShaderStages::FRAGMENT,
            [uniform, texture, sampler],
        ),
    ]
}

/// A uniform buffer for one view with its bind group.
pub(super) fn view_group(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    label: &str,
) -> (wgpu::Buffer, wgpu::BindGroup) {
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: size_of::<ViewUniform>() as u64,
        usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    });
    let group = gpu.bind(layout, [buffer.as_entire_binding()]);
    (buffer, group)
}

impl Renderer {
    /// Copies a scene to the device. Meshes of one material become one draw.
    pub fn upload(&self, gpu: &Gpu, scene: &Scene) -> Result<Model, LabError> {
        let limit = gpu.device.limits().max_buffer_size;
        let mut of_material = vec![Vec::new(); scene.materials.len()];
        for mesh in &scene.meshes {
            if let Some(meshes) = of_material.get_mut(mesh.material) {
                meshes.push(mesh);
            }
        }
        let mut drawn = Vec::new();
        for (material, meshes) in of_material.into_iter().enumerate() {
            let mut vertices = Vec::new();
            let mut indices = Vec::new();
            for mesh in meshes {
                let first = vertices.len() as u32;
                let alphas = mesh.alphas.iter().copied();
                let attributes = mesh.positions.iter().zip(&mesh.normals).zip(&mesh.uvs);
                let attributes = attributes.zip(alphas.chain(std::iter::repeat(1.0)));
                vertices.extend(
                    attributes.map(|(((&position, &normal), &uv), alpha)| Vertex {
                        position,
                        normal,
                        uv,
                        alpha,
                    }),
                );
                indices.extend(mesh.indices.iter().map(|index| first + index));
            }
            let bytes = size_of_val(&vertices[..]).max(size_of_val(&indices[..])) as u64;
            if bytes > limit {
                return Err(LabError::refused(format!(
                    "a buffer of the scene would have {bytes} bytes; this device allows 1 to {limit}"
                )));
            }
            if !indices.is_empty() {
                drawn.push((material, vertices, indices));
            }
        }
        created(gpu, "the scene's buffers and textures", || {
            let white = upload_image(gpu, &white());
            let images: Vec<_> = scene
                .images
                .iter()
                .map(|image| upload_image(gpu, image))
                .collect();
            let parts = drawn
                .iter()
                .map(|(index, vertices, indices)| {
                    let material = &scene.materials[*index];
                    let image = material
                        .texture
                        .and_then(|texture| images.get(texture))
                        .unwrap_or(&white);
                    let surface = SurfaceUniform {
                        base_colour: material.base_colour,
                        mask: material.mask.unwrap_or(-1.0),
                        _padding: [0.0; 3],
                    };
                    Part {
                        vertices: gpu.filled(
                            "host/vertices",
                            bytemuck::cast_slice(vertices),
                            wgpu::BufferUsages::VERTEX,
                        ),
                        indices: gpu.filled(
                            "host/indices",
                            bytemuck::cast_slice(indices),
                            wgpu::BufferUsages::INDEX,
                        ),
                        count: indices.len() as u32,
                        material: self.material_group(gpu, &surface, image, material),
                        masked: material.mask.is_some(),
                    }
                })
                .collect();
            Model { parts }
        })
    }

    fn material_group(
        &self,
        gpu: &Gpu,
        surface: &SurfaceUniform,
        image: &wgpu::TextureView,
        material: &Material,
    ) -> wgpu::BindGroup {
        let sampler = material_sampler(gpu, material);
        let contents = bytemuck::bytes_of(surface);
        let uniform = gpu.filled("host/material", contents, wgpu::BufferUsages::UNIFORM);
        let bound = [
            uniform.as_entire_binding(),
            wgpu::BindingResource::TextureView(image),
            wgpu::BindingResource::Sampler(&sampler),
        ];
        gpu.bind(&self.material_layout, bound)
    }
}

impl Model {
    /// Draws all triangles, masked materials by `masked` and the others by `opaque`.
    pub(super) fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        view: &wgpu::BindGroup,
        opaque: &wgpu::RenderPipeline,
        masked: &wgpu::RenderPipeline,
    ) {
        pass.set_bind_group(0, view, &[]);
        for part in &self.parts {
            pass.set_pipeline(if part.masked { masked } else { opaque });
            pass.set_bind_group(1, &part.material, &[]);
            pass.set_vertex_buffer(0, part.vertices.slice(..));
            pass.set_index_buffer(part.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..part.count, 0, 0..1);
        }
    }
}

/// How a material's image is read.
pub(crate) fn material_sampler(gpu: &Gpu, material: &Material) -> wgpu::Sampler {
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("host/base colour"),
        address_mode_u: material.wrap[0],
        address_mode_v: material.wrap[1],
        mag_filter: material.filter,
        min_filter: material.filter,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        ..Default::default()
    })
}

/// A material's image alone, or white.
pub(crate) fn material_image(gpu: &Gpu, scene: &Scene, material: &Material) -> wgpu::TextureView {
    let image = material
        .texture
        .and_then(|texture| scene.images.get(texture));
    image.map_or_else(
        || upload_image(gpu, &white()),
        |image| upload_image(gpu, image),
    )
}

/// What stands for a missing image.
fn white() -> Image {
    Image {
        width: 1,
        height: 1,
        rgba: vec![255; 4],
    }
}

/// A texture with all its mips.
fn upload_image(gpu: &Gpu, image: &Image) -> wgpu::TextureView {
    let mips = mips(image);
    let bytes: Vec<u8> = mips.iter().flat_map(|mip| &mip.rgba).copied().collect();
    let texture = gpu.device.create_texture_with_data(
        &gpu.queue,
        &wgpu::TextureDescriptor {
            label: Some("host/base colour"),
            size: wgpu::Extent3d {
                width: image.width,
                height: image.height,
                depth_or_array_layers: 1,
            },
            mip_level_count: mips.len() as u32,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba8UnormSrgb,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::LayerMajor,
        &bytes,
    );
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
