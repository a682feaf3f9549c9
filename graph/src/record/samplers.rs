//! The samplers of a plan's passes, in wgpu's terms.

use crate::{AddressMode, CompareFunction, FilterMode, PlannedSampler};

/// The sampler of a state.
pub(super) fn sampler(device: &wgpu::Device, state: &PlannedSampler, label: &str) -> wgpu::Sampler {
    let address = |mode: AddressMode| match mode {
        AddressMode::ClampToEdge => wgpu::AddressMode::ClampToEdge,
    };
    let filter = |mode: FilterMode| match mode {
        FilterMode::Nearest => wgpu::FilterMode::Nearest,
        FilterMode::Linear => wgpu::FilterMode::Linear,
    };
    device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some(label),
        address_mode_u: address(state.address_mode_u),
        address_mode_v: address(state.address_mode_v),
        mag_filter: filter(state.mag_filter),
        min_filter: filter(state.min_filter),
        mipmap_filter: match state.mipmap_filter {
            FilterMode::Nearest => wgpu::MipmapFilterMode::Nearest,
            FilterMode::Linear => wgpu::MipmapFilterMode::Linear,
        },
        anisotropy_clamp: state.max_anisotropy,
        compare: state.compare.map(|compare| match compare {
            CompareFunction::Less => wgpu::CompareFunction::Less,
            CompareFunction::Greater => wgpu::CompareFunction::Greater,
        }),
        ..Default::default()
    })
}
