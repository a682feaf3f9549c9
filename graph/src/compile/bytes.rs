//! How many bytes a pass moves.

use crate::{PlannedBindingResource, PlannedPass, PlannedResource, PlannedWork};

/// Every texel that a pass binds is counted once, however often the shader loads it: what has to cross the memory bus.
pub(super) fn count(pass: &mut PlannedPass, resources: &[PlannedResource]) {
    let layers = u64::from(pass.layers);
    let whole = |resource: usize| resources[resource].desc.bytes();
    let level = |resource: usize, level: u32| {
        let texture = resources[resource].desc.texture();
        texture.map_or(0, |texture| texture.bytes_per_level(level) * layers)
    };
    let (mut read, mut written) = (0, 0);
    for binding in &pass.bindings {
        match &binding.resource {
            PlannedBindingResource::Texture {
                resource,
                one_layer: true,
                level: bound,
                ..
            } => read += level(*resource, *bound),
            PlannedBindingResource::Texture { resource, .. } => read += whole(*resource),
            PlannedBindingResource::StorageTexture {
                resource,
                level: bound,
                ..
            } => written += level(*resource, *bound),
            PlannedBindingResource::Buffer { resource, writable } => {
                read += whole(*resource);
                written += if *writable { whole(*resource) } else { 0 };
            }
            PlannedBindingResource::Parameters { size, .. }
            | PlannedBindingResource::Regions { size, .. } => read += u64::from(*size) * layers,
            PlannedBindingResource::Sampler { .. }
            | PlannedBindingResource::ComparisonSampler { .. } => {}
        }
    }
    match &pass.work {
        PlannedWork::Compute { .. } => {}
        PlannedWork::Fullscreen {
            target,
            level: drawn,
            ..
        } => written += level(*target, *drawn),
        PlannedWork::Host {
            targets,
            blend,
            depth,
        } => {
            let colour: u64 = targets.iter().map(|&target| level(target, 0)).sum();
            written += colour + depth.map_or(0, |target| level(target, 0));
            read += if *blend { colour } else { 0 };
        }
    }
    pass.bytes_read = read;
    pass.bytes_written = written;
}
