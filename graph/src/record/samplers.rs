//! The samplers of a plan's passes. They clamp to the edge, which is wgpu's default.

use crate::PlannedBindingResource;

/// The sampler that a binding holds.
pub(super) fn sampler(
    device: &wgpu::Device,
    resource: &PlannedBindingResource,
    label: &str,
) -> wgpu::Sampler {
    let mut descriptor = wgpu::SamplerDescriptor {
        label: Some(label),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        ..Default::default()
    };
    if let PlannedBindingResource::ComparisonSampler { reversed } = *resource {
        descriptor.compare = Some(if reversed {
            wgpu::CompareFunction::Less
        } else {
            wgpu::CompareFunction::Greater
        });
    }
    if let PlannedBindingResource::Sampler {
        filtering,
        anisotropy,
    } = *resource
    {
        descriptor.anisotropy_clamp = anisotropy;
        if filtering {
            descriptor.mipmap_filter = wgpu::MipmapFilterMode::Linear;
        } else {
            descriptor.mag_filter = wgpu::FilterMode::Nearest;
            descriptor.min_filter = wgpu::FilterMode::Nearest;
        }
    }
    device.create_sampler(&descriptor)
}
