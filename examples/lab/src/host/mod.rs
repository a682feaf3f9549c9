//! The reference host: a small renderer that owns geometry, light depth and a G-buffer, as a host engine would.
//!
//! It never sees moments: what lies between its light depth and a shadow intensity is the library's.

mod error;
mod light_map;
mod model;
mod read;
mod shade;
mod surface;

pub use error::HostError;
pub use light_map::{LightMap, LightMapDesc};
pub use model::Model;
pub use read::{DepthSamples, SurfacePixels, read_depth_samples, read_gbuffer};
pub use shade::Lighting;
pub use surface::Surface;

use crate::gpu::Gpu;
use error::created;

/// What all draws share: shaders, layouts, and the pipelines that depend on nothing else.
pub struct Renderer {
    geometry: wgpu::ShaderModule,
    view_layout: wgpu::BindGroupLayout,
    material_layout: wgpu::BindGroupLayout,
    geometry_layout: wgpu::PipelineLayout,
    surface_pipeline: wgpu::RenderPipeline,
    shade_layout: wgpu::BindGroupLayout,
    shade_pipeline: wgpu::RenderPipeline,
}

impl Renderer {
    /// Compiles the shaders and makes the pipelines of the G-buffer and of the picture.
    pub fn new(gpu: &Gpu) -> Result<Self, HostError> {
        created(gpu, "the host's pipelines", || {
            let device = &gpu.device;
            let geometry = device.create_shader_module(wgpu::include_wgsl!("geometry.wgsl"));
            let view_layout = model::view_layout(device);
            let material_layout = model::material_layout(device);
            let geometry_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("host/geometry"),
                bind_group_layouts: &[Some(&view_layout), Some(&material_layout)],
                immediate_size: 0,
            });
            let surface_pipeline = surface::pipeline(device, &geometry, &geometry_layout);
            let shade_layout = shade::layout(device);
            let shade_pipeline = shade::pipeline(device, &shade_layout);
            Self {
                geometry,
                view_layout,
                material_layout,
                geometry_layout,
                surface_pipeline,
                shade_layout,
                shade_pipeline,
            }
        })
    }
}

/// A binding of a fragment or compute shader.
fn binding(
    binding: u32,
    visibility: wgpu::ShaderStages,
    ty: wgpu::BindingType,
) -> wgpu::BindGroupLayoutEntry {
    wgpu::BindGroupLayoutEntry {
        binding,
        visibility,
        ty,
        count: None,
    }
}

/// A whole uniform buffer.
const UNIFORM: wgpu::BindingType = wgpu::BindingType::Buffer {
    ty: wgpu::BufferBindingType::Uniform,
    has_dynamic_offset: false,
    min_binding_size: None,
};

/// A texture of the given kind of samples.
fn texture_type(sample_type: wgpu::TextureSampleType, multisampled: bool) -> wgpu::BindingType {
    wgpu::BindingType::Texture {
        sample_type,
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled,
    }
}

/// A two-dimensional texture without mips.
fn texture_2d(
    device: &wgpu::Device,
    label: &str,
    size: [u32; 2],
    samples: u32,
    format: wgpu::TextureFormat,
    usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d {
            width: size[0],
            height: size[1],
            depth_or_array_layers: 1,
        },
        mip_level_count: 1,
        sample_count: samples,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}
