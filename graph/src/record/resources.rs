//! The textures and buffers that a plan creates.

use super::ImportedResource;
use super::format::texture_usages;
use super::scope::{check_alive, scoped};
use crate::{GraphError, Home, Plan, PlannedMemory, PlannedResource, ResourceDesc, Usage};

/// Everything that a plan creates for one set of sizes. A resize makes new resources and no pipeline.
#[derive(Debug)]
pub struct Resources {
    memory: Vec<(PlannedMemory, ImportedResource)>,
}

impl Resources {
    /// Creates the textures and buffers of a plan.
    pub async fn create(device: &wgpu::Device, plan: &Plan) -> Result<Self, GraphError> {
        plan.check()?;
        let mut memory = Vec::with_capacity(plan.memory.len());
        for planned in &plan.memory {
            let label = format!("moment-shadows/{}", planned.label);
            let create = || match &planned.desc {
                ResourceDesc::Texture(texture) => {
                    ImportedResource::Texture(device.create_texture(&wgpu::TextureDescriptor {
                        label: Some(&label),
                        size: wgpu::Extent3d {
                            width: texture.size[0],
                            height: texture.size[1],
                            depth_or_array_layers: texture.array_layers(),
                        },
                        mip_level_count: texture.mips,
                        sample_count: texture.samples,
                        dimension: wgpu::TextureDimension::D2,
                        format: texture.wgpu_format(),
                        usage: texture_usages(&planned.usage),
                        view_formats: &[],
                    }))
                }
                ResourceDesc::Buffer { size } => {
                    let mut usage = wgpu::BufferUsages::STORAGE;
                    let copied = planned.usage.contains(&Usage::CopySrc);
                    usage.set(wgpu::BufferUsages::COPY_SRC, copied);
                    ImportedResource::Buffer(device.create_buffer(&wgpu::BufferDescriptor {
                        label: Some(&label),
                        size: *size,
                        usage,
                        mapped_at_creation: false,
                    }))
                }
            };
            let created = scoped(device, &label, create).await?;
            memory.push((planned.clone(), created));
        }
        check_alive(device).await?;
        Ok(Self { memory })
    }

    /// Whether these are the resources of a plan.
    pub(super) fn fit(&self, plan: &Plan) -> bool {
        self.memory
            .iter()
            .map(|(planned, _)| planned)
            .eq(&plan.memory)
    }

    /// The object behind a resource that is not an import.
    pub(super) fn get(&self, resource: &PlannedResource) -> Option<&ImportedResource> {
        match resource.home {
            Home::Import(_) => None,
            Home::Memory(index) => self.memory.get(index).map(|(_, created)| created),
        }
    }
}
