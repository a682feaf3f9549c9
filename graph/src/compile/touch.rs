//! What a pass touches.

use crate::{Access, PlannedBindingResource, PlannedPass, PlannedWork};

/// A resource that a pass touches.
pub(super) struct Touch {
    pub(super) resource: usize,
    pub(super) access: Access,
    /// Only the layer that the pass is recorded for.
    pub(super) one_layer: bool,
    /// Only this mip level; all, where `None`.
    pub(super) level: Option<u32>,
}

impl Touch {
    /// Whether both touch the same texels, of some layer.
    pub(super) fn meets(&self, other: &Touch) -> bool {
        let levels = self.level.zip(other.level);
        self.resource == other.resource && levels.is_none_or(|(one, other)| one == other)
    }
}

/// Everything a pass touches, and how.
pub(super) fn touched(pass: &PlannedPass) -> Vec<Touch> {
    let touch = |resource: usize, access: Access, one_layer: bool, level: Option<u32>| Touch {
        resource,
        access,
        one_layer,
        level,
    };
    let bound = pass
        .bindings
        .iter()
        .filter_map(|binding| match binding.resource {
            PlannedBindingResource::Texture {
                resource,
                one_layer,
                level,
                ..
            } => {
                let level = one_layer.then_some(level);
                Some(touch(resource, Access::READ, one_layer, level))
            }
            PlannedBindingResource::StorageTexture {
                resource, level, ..
            } => Some(touch(resource, Access::STORAGE_WRITE, true, Some(level))),
            PlannedBindingResource::Buffer { resource, writable } => {
                let write = Access {
                    storage_write: writable,
                    ..Access::READ
                };
                Some(touch(resource, write, false, None))
            }
            PlannedBindingResource::Parameters { .. }
            | PlannedBindingResource::Regions { .. }
            | PlannedBindingResource::Sampler { .. }
            | PlannedBindingResource::ComparisonSampler { .. } => None,
        });
    let mut touched: Vec<Touch> = bound.collect();
    match &pass.work {
        PlannedWork::Compute { .. } => {}
        PlannedWork::Fullscreen { target, level, .. } => {
            touched.push(touch(*target, Access::RENDER_TARGET, true, Some(*level)));
        }
        PlannedWork::Host { targets, depth, .. } => {
            let all = targets.iter().chain(depth);
            touched.extend(all.map(|&target| touch(target, Access::RENDER_TARGET, true, Some(0))));
        }
    }
    touched
}
