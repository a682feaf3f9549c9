//! Explicit bind group layouts, from a pass's planned bindings.

use crate::{Plan, PlannedBindingResource, PlannedPass, PlannedWork, SampleType};

/// The entries of a pass's layout.
pub(super) fn entries(plan: &Plan, pass: &PlannedPass) -> Vec<wgpu::BindGroupLayoutEntry> {
    let visibility = match pass.work {
        PlannedWork::Fullscreen { .. } => wgpu::ShaderStages::FRAGMENT,
        PlannedWork::Compute { .. } | PlannedWork::Host { .. } => wgpu::ShaderStages::COMPUTE,
    };
    pass.bindings
        .iter()
        .map(|binding| wgpu::BindGroupLayoutEntry {
            binding: binding.variable,
            visibility,
            ty: binding_type(plan, &binding.resource),
            count: None,
        })
        .collect()
}

fn binding_type(plan: &Plan, resource: &PlannedBindingResource) -> wgpu::BindingType {
    match *resource {
        PlannedBindingResource::Parameters { size, .. }
        | PlannedBindingResource::Regions { size, .. } => wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: true,
            min_binding_size: wgpu::BufferSize::new(u64::from(size)),
        },
        PlannedBindingResource::Texture {
            one_layer,
            sample,
            multisampled,
            ..
        } => wgpu::BindingType::Texture {
            sample_type: match sample {
                SampleType::Depth => wgpu::TextureSampleType::Depth,
                SampleType::Filterable => wgpu::TextureSampleType::Float { filterable: true },
                SampleType::Unfilterable => wgpu::TextureSampleType::Float { filterable: false },
                SampleType::Integer => wgpu::TextureSampleType::Uint,
            },
            view_dimension: if one_layer {
                wgpu::TextureViewDimension::D2
            } else {
                wgpu::TextureViewDimension::D2Array
            },
            multisampled,
        },
        PlannedBindingResource::StorageTexture { resource, .. } => {
            let texture = plan.resources[resource].desc.texture();
            wgpu::BindingType::StorageTexture {
                access: wgpu::StorageTextureAccess::WriteOnly,
                // `Plan::check` has refused a buffer.
                format: texture.map_or(wgpu::TextureFormat::Rgba32Float, |texture| {
                    texture.wgpu_format()
                }),
                view_dimension: wgpu::TextureViewDimension::D2,
            }
        }
        PlannedBindingResource::Buffer { writable, .. } => wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage {
                read_only: !writable,
            },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        PlannedBindingResource::Sampler { filtering, .. } => {
            wgpu::BindingType::Sampler(if filtering {
                wgpu::SamplerBindingType::Filtering
            } else {
                wgpu::SamplerBindingType::NonFiltering
            })
        }
        PlannedBindingResource::ComparisonSampler { .. } => {
            wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison)
        }
    }
}
