//! The reference host: a small renderer that owns geometry, light depth and a G-buffer, as a host engine would.
//!
//! It never sees moments: what lies between its light depth and a shadow intensity is the library's.

mod depth_map;
mod error;
mod model;
mod read;
mod shade;
mod surface;

pub use depth_map::{DepthMap, DepthMapDesc};
pub use model::Model;
pub(crate) use model::{material_image, material_sampler};
pub use read::{DepthSamples, SurfacePixels, read_depth_samples, read_gbuffer};
pub use shade::Lighting;
pub use surface::Surface;

use crate::error::LabError;
use crate::gpu::Gpu;
use error::created;

/// What all draws share: shaders, layouts, and the pipelines that depend on nothing else.
pub struct Renderer {
    geometry: wgpu::ShaderModule,
    view_layout: wgpu::BindGroupLayout,
    material_layout: wgpu::BindGroupLayout,
    geometry_layout: wgpu::PipelineLayout,
    surface_pipeline: wgpu::RenderPipeline,
    shade_pipeline: wgpu::RenderPipeline,
}

impl Renderer {
    /// Compiles the shaders and makes the pipelines of the G-buffer and of the picture.
    pub fn new(gpu: &Gpu) -> Result<Self, LabError> {
        created(gpu, "the host's pipelines", || {
            let device = &gpu.device;
            let geometry = device.create_shader_module(wgpu::include_wgsl!("geometry.wgsl"));
            let [view_layout, material_layout] = model::layouts(device);
            let geometry_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
                label: Some("host/geometry"),
                bind_group_layouts: &[Some(&view_layout), Some(&material_layout)],
                immediate_size: 0,
            });
            let surface_pipeline = surface::pipeline(device, &geometry, &geometry_layout);
            let shade_pipeline = shade::pipeline(device);
            Self {
                geometry,
                view_layout,
                material_layout,
                geometry_layout,
                surface_pipeline,
                shade_pipeline,
            }
        })
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
