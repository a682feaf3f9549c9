//! Explicit bind group layouts, from a pass's planned bindings.

use moment_shadows::TextureFormat;

use super::format::texture_format;
use crate::{Plan, PlannedBindingResource, PlannedPass, PlannedWork, SampleType};

/// What a layout depends on: passes with equal keys share it.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct LayoutKey {
    entries: Vec<(u32, EntryKey)>,
    fragment: bool,
}

#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum EntryKey {
    Uniform(u32),
    Texture {
        sample: SampleType,
        array: bool,
        multisampled: bool,
    },
    Storage(Option<TextureFormat>),
    Buffer {
        writable: bool,
    },
    Sampler {
        filtering: bool,
    },
    ComparisonSampler,
}

impl LayoutKey {
    pub(super) fn of(plan: &Plan, pass: &PlannedPass) -> Self {
        let entries = pass
            .bindings
            .iter()
            .map(|binding| {
                let entry = match binding.resource {
                    PlannedBindingResource::Parameters { size, .. }
                    | PlannedBindingResource::Regions { size, .. } => EntryKey::Uniform(size),
                    PlannedBindingResource::Texture {
                        one_layer,
                        sample,
                        multisampled,
                        ..
                    } => EntryKey::Texture {
                        sample,
                        array: !one_layer,
                        multisampled,
                    },
                    PlannedBindingResource::StorageTexture { resource, .. } => EntryKey::Storage(
                        plan.resources[resource]
                            .desc
                            .texture()
                            .map(|texture| texture.format),
                    ),
                    PlannedBindingResource::Buffer { writable, .. } => {
                        EntryKey::Buffer { writable }
                    }
                    PlannedBindingResource::Sampler { filtering, .. } => {
                        EntryKey::Sampler { filtering }
                    }
                    PlannedBindingResource::ComparisonSampler { .. } => EntryKey::ComparisonSampler,
                };
                (binding.binding, entry)
            })
            .collect();
        Self {
            entries,
            fragment: matches!(pass.work, PlannedWork::Fullscreen { .. }),
        }
    }

    pub(super) fn create(&self, device: &wgpu::Device, label: &str) -> wgpu::BindGroupLayout {
        let visibility = if self.fragment {
            wgpu::ShaderStages::FRAGMENT
        } else {
            wgpu::ShaderStages::COMPUTE
        };
        let entries: Vec<wgpu::BindGroupLayoutEntry> = self
            .entries
            .iter()
            .map(|(binding, entry)| wgpu::BindGroupLayoutEntry {
                binding: *binding,
                visibility,
                ty: binding_type(entry),
                count: None,
            })
            .collect();
        device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(label),
            entries: &entries,
        })
    }
}

fn binding_type(entry: &EntryKey) -> wgpu::BindingType {
    match *entry {
        EntryKey::Uniform(size) => wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: true,
            min_binding_size: wgpu::BufferSize::new(u64::from(size)),
        },
        EntryKey::Texture {
            sample,
            array,
            multisampled,
        } => wgpu::BindingType::Texture {
            sample_type: match sample {
                SampleType::Depth => wgpu::TextureSampleType::Depth,
                SampleType::Filterable => wgpu::TextureSampleType::Float { filterable: true },
                SampleType::Unfilterable => wgpu::TextureSampleType::Float { filterable: false },
                SampleType::Integer => wgpu::TextureSampleType::Uint,
            },
            view_dimension: if array {
                wgpu::TextureViewDimension::D2Array
            } else {
                wgpu::TextureViewDimension::D2
            },
            multisampled,
        },
        EntryKey::Storage(format) => wgpu::BindingType::StorageTexture {
            access: wgpu::StorageTextureAccess::WriteOnly,
            // `Plan::check` has refused a buffer.
            format: format.map_or(wgpu::TextureFormat::Rgba32Float, texture_format),
            view_dimension: wgpu::TextureViewDimension::D2,
        },
        EntryKey::Buffer { writable } => wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage {
                read_only: !writable,
            },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        EntryKey::Sampler { filtering } => wgpu::BindingType::Sampler(if filtering {
            wgpu::SamplerBindingType::Filtering
        } else {
            wgpu::SamplerBindingType::NonFiltering
        }),
        EntryKey::ComparisonSampler => {
            wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison)
        }
    }
}
