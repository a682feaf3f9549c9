//! The layout of a pass's bindings, and its samplers.

use moment_shadows_graph::{
    BindingLayout, BufferKind, PlannedBinding, PlannedPass, PlannedSampler, SampleType,
};
use wgpu::{BindingType, BufferBindingType, TextureSampleType};

use super::names::by_name;
use crate::error::HostError;

pub(super) fn entry(
    pass: &PlannedPass,
    binding: &PlannedBinding,
) -> Result<wgpu::BindGroupLayoutEntry, HostError> {
    Ok(wgpu::BindGroupLayoutEntry {
        binding: binding.binding,
        visibility: by_name(pass.visibility)?,
        ty: binding_type(binding.layout)?,
        count: None,
    })
}

fn binding_type(layout: BindingLayout) -> Result<BindingType, HostError> {
    Ok(match layout {
        BindingLayout::Buffer {
            ty,
            has_dynamic_offset,
            min_binding_size,
        } => BindingType::Buffer {
            ty: match ty {
                BufferKind::Uniform => BufferBindingType::Uniform,
                BufferKind::Storage => BufferBindingType::Storage { read_only: false },
                BufferKind::ReadOnlyStorage => BufferBindingType::Storage { read_only: true },
            },
            has_dynamic_offset,
            min_binding_size: wgpu::BufferSize::new(min_binding_size.into()),
        },
        BindingLayout::Sampler { ty } => BindingType::Sampler(by_name(ty)?),
        BindingLayout::Texture {
            sample_type,
            view_dimension,
            multisampled,
        } => BindingType::Texture {
            sample_type: match sample_type {
                SampleType::Depth => TextureSampleType::Depth,
                SampleType::Uint => TextureSampleType::Uint,
                SampleType::Float => TextureSampleType::Float { filterable: true },
                SampleType::UnfilterableFloat => TextureSampleType::Float { filterable: false },
            },
            view_dimension: by_name(view_dimension)?,
            multisampled,
        },
        BindingLayout::StorageTexture {
            access,
            format,
            view_dimension,
        } => BindingType::StorageTexture {
            access: by_name(access)?,
            format: by_name(format)?,
            view_dimension: by_name(view_dimension)?,
        },
    })
}

pub(super) fn sampler(
    device: &wgpu::Device,
    state: &PlannedSampler,
) -> Result<wgpu::Sampler, HostError> {
    Ok(device.create_sampler(&wgpu::SamplerDescriptor {
        address_mode_u: by_name(state.address_mode_u)?,
        address_mode_v: by_name(state.address_mode_v)?,
        mag_filter: by_name(state.mag_filter)?,
        min_filter: by_name(state.min_filter)?,
        mipmap_filter: by_name(state.mipmap_filter)?,
        anisotropy_clamp: state.max_anisotropy,
        compare: by_name(state.compare)?,
        ..Default::default()
    }))
}
