//! A plan of other sizes.

use moment_shadows_graph::{Home, Plan, PlannedWork, ResourceDesc, TextureDesc};

use crate::error::HostError;

/// The plan for imports of other sizes.
pub fn resized(plan: &Plan, size_of: impl Fn(&str) -> [u32; 2]) -> Result<Plan, HostError> {
    let mut plan = plan.clone();
    let sizes = plan.imports.iter().map(|import| size_of(&import.name));
    let sizes: Vec<[u32; 2]> = sizes.collect();
    for resource in &mut plan.resources {
        let (Some(extent), ResourceDesc::Texture(texture)) = (resource.extent, &mut resource.desc)
        else {
            continue;
        };
        let size = sizes[extent.import];
        texture.size = [0, 1].map(|axis| size[axis].div_ceil(extent.per[axis]));
        if TextureDesc::most_levels(texture.size) < texture.mips {
            return Err(HostError::TooSmall {
                map: resource.name.clone(),
                size: texture.size,
                smallest: 1 << (texture.mips - 1),
            });
        }
        if let Home::Memory(memory) = resource.home
            && let ResourceDesc::Texture(memory) = &mut plan.memory[memory].desc
        {
            memory.size = texture.size;
        }
    }
    for table in &mut plan.parameters.regions {
        if table.capacity > 1 {
            return Err(HostError::Regions(table.map.clone()));
        }
        let mut resources = plan.resources.iter();
        let map = resources.find(|resource| resource.name == table.map);
        if let Some(map) = map.and_then(|map| map.desc.texture()) {
            table.extent = map.size;
        }
        if table.extent[0].min(table.extent[1]) < table.smallest {
            return Err(HostError::TooSmall {
                map: table.map.clone(),
                size: table.extent,
                smallest: table.smallest,
            });
        }
    }
    for pass in &mut plan.passes {
        if let PlannedWork::Compute {
            workgroups,
            covers,
            level,
            texels_per_workgroup,
            ..
        } = &mut pass.work
            && let Some(texture) = plan.resources[*covers].desc.texture()
        {
            let size = texture.size_at(*level);
            *workgroups = [0, 1].map(|axis| size[axis].div_ceil(texels_per_workgroup[axis]));
        }
    }
    Ok(plan)
}
