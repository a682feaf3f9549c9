//! What a pass touches.

use super::{PlannedBindingResource, PlannedPass, PlannedWork};
use crate::Access;

/// A resource that a pass touches.
pub(crate) struct Touch {
    /// Index into the plan's resources.
    pub(crate) resource: usize,
    pub(crate) access: Access,
    pub(crate) part: Part,
}

/// As much of a resource as a pass touches.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Part {
    Buffer,
    /// All layers of a texture, with all their planes and mip levels.
    Layers,
    /// One mip level of one plane of the layer that the pass is recorded for.
    Level {
        level: u32,
        plane: u32,
    },
}

impl Touch {
    /// Whether both touch the same texels, of some layer.
    pub(crate) fn meets(&self, other: &Touch) -> bool {
        let apart = match (self.part, other.part) {
            (Part::Level { level, .. }, Part::Level { level: other, .. }) => level != other,
            (Part::Buffer | Part::Layers, _) | (_, Part::Buffer | Part::Layers) => false,
        };
        self.resource == other.resource && !apart
    }
}

impl PlannedPass {
    /// Everything that the pass touches, and how: what its bindings hold, then its targets.
    pub(crate) fn touches(&self) -> Vec<Touch> {
        let bindings = self.bindings.iter();
        let mut touches: Vec<Touch> = bindings.filter_map(|it| it.resource.touch()).collect();
        let mut draw = |resource: usize, level: u32, plane: u32| {
            touches.push(Touch {
                resource,
                access: Access::RENDER_TARGET,
                part: Part::Level { level, plane },
            });
        };
        match &self.work {
            PlannedWork::Compute { .. } => {}
            &PlannedWork::Fullscreen {
                target,
                level,
                plane,
                ..
            } => draw(target, level, plane),
            PlannedWork::Host { targets, depth, .. } => {
                let drawn = targets.iter().chain(depth);
                drawn.for_each(|&target| draw(target, 0, 0));
            }
        }
        touches
    }
}

impl PlannedBindingResource {
    /// The resource that it touches, if any.
    pub(crate) fn touch(&self) -> Option<Touch> {
        let (resource, access, part) = match *self {
            PlannedBindingResource::Texture {
                resource,
                one_layer: false,
                ..
            } => (resource, Access::READ, Part::Layers),
            PlannedBindingResource::Texture {
                resource,
                level,
                plane,
                ..
            } => (resource, Access::READ, Part::Level { level, plane }),
            PlannedBindingResource::StorageTexture {
                resource,
                level,
                plane,
            } => {
                let part = Part::Level { level, plane };
                (resource, Access::STORAGE_WRITE, part)
            }
            PlannedBindingResource::Buffer { resource, writable } => {
                let mut access = Access::READ;
                access.storage_write = writable;
                (resource, access, Part::Buffer)
            }
            PlannedBindingResource::Parameters { .. }
            | PlannedBindingResource::Regions { .. }
            | PlannedBindingResource::Sampler { .. }
            | PlannedBindingResource::ComparisonSampler { .. } => return None,
        };
        Some(Touch {
            resource,
            access,
            part,
        })
    }

    /// Bytes of uniform data of one layer; `None` for anything else.
    pub(crate) fn uniform_size(&self) -> Option<u32> {
        if let PlannedBindingResource::Parameters { size, .. }
        | PlannedBindingResource::Regions { size, .. } = self
        {
            Some(*size)
        } else {
            None
        }
    }
}
