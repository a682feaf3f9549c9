//! What a device has to have for a plan, by WebGPU's names.

use std::collections::{BTreeMap, BTreeSet};

use moment_shadows::{Profile, TextureFormat};

use crate::{
    BindingLayout, Capabilities, Plan, PlannedBindingResource, PlannedDevice, PlannedWork,
    ResourceDesc, SampleType, Usage,
};

/// Features and limits.
pub(super) fn of(plan: &Plan, capabilities: &Capabilities) -> PlannedDevice {
    let (mut features, mut wgpu_features) = (BTreeSet::new(), BTreeSet::new());
    for resource in &plan.resources {
        let Some(texture) = resource.desc.texture() else {
            continue;
        };
        features.extend(texture.format.webgpu_feature());
        let stored = resource.usage.contains(&Usage::StorageBinding);
        let core = texture.format.support(Profile::WebgpuCore);
        let samples = texture.format.is_depth() && !matches!(texture.samples, 0 | 1 | 4);
        if stored && !core.storage_write {
            features.insert(TextureFormat::TIER1);
        }
        if samples {
            wgpu_features.insert("TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES");
        }
    }
    for binding in plan.passes.iter().flat_map(|pass| &pass.bindings) {
        if let (
            BindingLayout::Texture {
                sample_type: SampleType::Float,
                ..
            },
            &PlannedBindingResource::Texture { resource, .. },
        ) = (binding.layout, &binding.resource)
            && let Some(texture) = plan.resources[resource].desc.texture()
        {
            let format = texture.format;
            if is_float32(format) {
                features.insert("float32-filterable");
            } else if format.webgpu_feature().is_some() {
                // WebGPU's feature does not let them be filtered.
                wgpu_features.insert("TEXTURE_FORMAT_16BIT_NORM");
            }
        }
    }
    PlannedDevice {
        features: features.into_iter().map(str::to_owned).collect(),
        wgpu_features: wgpu_features.into_iter().map(str::to_owned).collect(),
        limits: limits(plan, capabilities),
    }
}

fn is_float32(format: TextureFormat) -> bool {
    use TextureFormat as F;
    matches!(format, F::R32Float | F::Rg32Float | F::Rgba32Float)
}

/// What the plan needs of the limits that depend on the graph and the sizes of its imports.
fn limits(plan: &Plan, capabilities: &Capabilities) -> BTreeMap<String, u64> {
    let textures = || {
        let resources = plan.resources.iter();
        resources.filter_map(|resource| resource.desc.texture())
    };
    let uniforms = plan.passes.iter().flat_map(|pass| &pass.bindings);
    let uniform = uniforms.filter_map(|binding| binding.uniform_size()).max();
    let workgroups = plan.passes.iter().filter_map(|pass| match pass.work {
        PlannedWork::Compute { workgroups, .. } => Some(workgroups[0].max(workgroups[1])),
        PlannedWork::Fullscreen { .. } | PlannedWork::Host { .. } => None,
    });
    let buffers = plan.resources.iter().filter_map(|it| match it.desc {
        ResourceDesc::Buffer { size } => Some(size),
        ResourceDesc::Texture(_) => None,
    });
    let buffer = buffers.max();
    let limits = [
        ("maxBindGroups", Some(u64::from(plan.bind_group) + 1)),
        (
            "maxTextureDimension2D",
            textures().map(|it| it.size[0].max(it.size[1]).into()).max(),
        ),
        (
            "maxTextureArrayLayers",
            textures().map(|it| it.array_layers().into()).max(),
        ),
        ("maxUniformBufferBindingSize", uniform.map(u64::from)),
        (
            "maxComputeWorkgroupsPerDimension",
            workgroups.max().map(u64::from),
        ),
        ("maxStorageBufferBindingSize", buffer),
        (
            "minUniformBufferOffsetAlignment",
            uniform.map(|_| capabilities.uniform_alignment.max(16).into()),
        ),
    ];
    let limits = limits.into_iter();
    limits
        .filter_map(|(name, value)| Some((name.to_owned(), value?)))
        .collect()
}
