//! Explicit bind group layouts, in wgpu's terms.

use crate::{
    BindingLayout, BufferKind, PlannedPass, SampleType, SamplerKind, StorageAccess, ViewDimension,
    Visibility,
};

/// The entries of a pass's layout.
pub(super) fn entries(pass: &PlannedPass) -> Vec<wgpu::BindGroupLayoutEntry> {
    let visibility = match pass.visibility {
        Some(Visibility::Fragment) => wgpu::ShaderStages::FRAGMENT,
        Some(Visibility::Compute) => wgpu::ShaderStages::COMPUTE,
        None => wgpu::ShaderStages::NONE,
    };
    let entries = pass.bindings.iter();
    let entries = entries.map(|binding| wgpu::BindGroupLayoutEntry {
        binding: binding.binding,
        visibility,
        ty: binding_type(binding.layout),
        count: None,
    });
    entries.collect()
}

fn binding_type(layout: BindingLayout) -> wgpu::BindingType {
    match layout {
        BindingLayout::Buffer {
            ty,
            has_dynamic_offset,
            min_binding_size,
        } => wgpu::BindingType::Buffer {
            ty: match ty {
                BufferKind::Uniform => wgpu::BufferBindingType::Uniform,
                BufferKind::Storage => wgpu::BufferBindingType::Storage { read_only: false },
                BufferKind::ReadOnlyStorage => wgpu::BufferBindingType::Storage { read_only: true },
            },
            has_dynamic_offset,
            min_binding_size: wgpu::BufferSize::new(u64::from(min_binding_size)),
        },
        BindingLayout::Sampler { ty } => wgpu::BindingType::Sampler(match ty {
            SamplerKind::Filtering => wgpu::SamplerBindingType::Filtering,
            SamplerKind::NonFiltering => wgpu::SamplerBindingType::NonFiltering,
            SamplerKind::Comparison => wgpu::SamplerBindingType::Comparison,
        }),
        BindingLayout::Texture {
            sample_type,
            view_dimension,
            multisampled,
        } => wgpu::BindingType::Texture {
            sample_type: match sample_type {
                SampleType::Depth => wgpu::TextureSampleType::Depth,
                SampleType::Float => wgpu::TextureSampleType::Float { filterable: true },
                SampleType::UnfilterableFloat => {
                    wgpu::TextureSampleType::Float { filterable: false }
                }
                SampleType::Uint => wgpu::TextureSampleType::Uint,
            },
            view_dimension: dimension(view_dimension),
            multisampled,
        },
        BindingLayout::StorageTexture {
            access: StorageAccess::WriteOnly,
            format,
            view_dimension,
        } => wgpu::BindingType::StorageTexture {
            access: wgpu::StorageTextureAccess::WriteOnly,
            format: super::format::wgpu_format(format),
            view_dimension: dimension(view_dimension),
        },
    }
}

fn dimension(dimension: ViewDimension) -> wgpu::TextureViewDimension {
    match dimension {
        ViewDimension::D2 => wgpu::TextureViewDimension::D2,
        ViewDimension::D2Array => wgpu::TextureViewDimension::D2Array,
    }
}
