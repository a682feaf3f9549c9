//! The samplers of a plan's passes. They clamp to the edge, which is wgpu's default.

pub(super) fn sampler(
    device: &wgpu::Device,
    filtering: bool,
    anisotropy: u16,
    label: &str,
) -> wgpu::Sampler {
    let (filter, mipmap_filter) = if filtering {
        (wgpu::FilterMode::Linear, wgpu::MipmapFilterMode::Linear)
    } else {
        (wgpu::FilterMode::Nearest, wgpu::MipmapFilterMode::Nearest)
    };
    device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some(label),
        mag_filter: filter,
        min_filter: filter,
        mipmap_filter,
        anisotropy_clamp: anisotropy,
        ..Default::default()
    })
}

pub(super) fn comparison_sampler(
    device: &wgpu::Device,
    reversed: bool,
    label: &str,
) -> wgpu::Sampler {
    device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some(label),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        compare: Some(if reversed {
            wgpu::CompareFunction::Less
        } else {
            wgpu::CompareFunction::Greater
        }),
        ..Default::default()
    })
}
