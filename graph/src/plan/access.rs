//! What a pass touches.

use super::{
    BindingLayout, BufferKind, PlannedBinding, PlannedBindingResource, PlannedPart, PlannedPass,
    PlannedWork, ViewDimension,
};
use crate::Access;

/// The most colour targets that WebGPU promises (`maxColorAttachments`).
pub(crate) const MOST_TARGETS: usize = 8;

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

impl PlannedPass {
    /// Everything that the pass touches, and how: what its bindings hold, then its targets.
    pub(crate) fn touches(&self) -> Vec<Touch> {
        let bindings = self.bindings.iter();
        let mut touches: Vec<Touch> = bindings.filter_map(PlannedBinding::touch).collect();
        let mut draw = |resource: usize, level: u32, plane: u32| {
            touches.push(Touch {
                resource,
                access: Access::RENDER_TARGET,
                part: Part::Level { level, plane },
            });
        };
        match &self.work {
            PlannedWork::Compute { .. } => {}
            &PlannedWork::Fullscreen { target, part, .. } => draw(target, part.level, part.plane),
            PlannedWork::Host {
                targets,
                planes,
                depth,
                ..
            } => {
                // Of a plan from elsewhere not more than `check` lets pass.
                let most = MOST_TARGETS as u32 + 1;
                for &target in targets {
                    (0..most.min(*planes)).for_each(|plane| draw(target, 0, plane));
                }
                depth.iter().for_each(|&target| draw(target, 0, 0));
            }
        }
        touches
    }
}

impl PlannedPass {
    /// Whether a target keeps some of its contents while it is drawn to.
    pub(crate) fn keeps(&self, touch: &Touch) -> bool {
        let kept = match &self.work {
            PlannedWork::Fullscreen { keeps, .. } => *keeps,
            PlannedWork::Host { blend, .. } => *blend,
            PlannedWork::Compute { .. } => false,
        };
        kept && touch.access.render_target
    }
}

impl From<PlannedPart> for Part {
    fn from(PlannedPart { level, plane }: PlannedPart) -> Self {
        Part::Level { level, plane }
    }
}

impl PlannedBinding {
    /// Whether its kind is that of what it holds.
    pub(crate) fn fits(&self) -> bool {
        let uniform = self.uniform_size().is_some();
        match (&self.resource, self.layout) {
            (
                PlannedBindingResource::Parameters { .. } | PlannedBindingResource::Regions { .. },
                BindingLayout::Buffer {
                    has_dynamic_offset, ..
                },
            ) => uniform && has_dynamic_offset,
            (
                PlannedBindingResource::Buffer { .. },
                BindingLayout::Buffer {
                    has_dynamic_offset, ..
                },
            ) => !uniform && !has_dynamic_offset,
            (
                PlannedBindingResource::Texture { part, .. },
                BindingLayout::Texture { view_dimension, .. },
            ) => part.is_some() == (view_dimension == ViewDimension::D2),
            (
                PlannedBindingResource::StorageTexture { .. },
                BindingLayout::StorageTexture { view_dimension, .. },
            ) => view_dimension == ViewDimension::D2,
            (PlannedBindingResource::Sampler(sampler), BindingLayout::Sampler { ty }) => {
                sampler.kind() == ty
            }
            (
                PlannedBindingResource::Parameters { .. }
                | PlannedBindingResource::Regions { .. }
                | PlannedBindingResource::Texture { .. }
                | PlannedBindingResource::StorageTexture { .. }
                | PlannedBindingResource::Buffer { .. }
                | PlannedBindingResource::Sampler(_),
                BindingLayout::Buffer { .. }
                | BindingLayout::Sampler { .. }
                | BindingLayout::Texture { .. }
                | BindingLayout::StorageTexture { .. },
            ) => false,
        }
    }

    /// The resource that it touches, if any.
    pub(crate) fn touch(&self) -> Option<Touch> {
        let (resource, access, part) = match self.resource {
            PlannedBindingResource::Texture { resource, part } => (
                resource,
                Access::READ,
                part.map_or(Part::Layers, Part::from),
            ),
            PlannedBindingResource::StorageTexture { resource, part } => {
                (resource, Access::STORAGE_WRITE, part.into())
            }
            PlannedBindingResource::Buffer { resource } => {
                let mut access = Access::READ;
                access.storage_write = matches!(
                    self.layout,
                    BindingLayout::Buffer {
                        ty: BufferKind::Storage,
                        ..
                    }
                );
                (resource, access, Part::Buffer)
            }
            PlannedBindingResource::Parameters { .. }
            | PlannedBindingResource::Regions { .. }
            | PlannedBindingResource::Sampler(_) => return None,
        };
        Some(Touch {
            resource,
            access,
            part,
        })
    }

    /// Bytes that are bound of a buffer at least; 0 of anything else.
    pub(crate) fn least_bytes(&self) -> u32 {
        match self.layout {
            BindingLayout::Buffer {
                min_binding_size, ..
            } => min_binding_size,
            BindingLayout::Sampler { .. }
            | BindingLayout::Texture { .. }
            | BindingLayout::StorageTexture { .. } => 0,
        }
    }

    /// Bytes of uniform data of one layer; `None` for anything else.
    pub(crate) fn uniform_size(&self) -> Option<u32> {
        let is_uniform = matches!(
            self.layout,
            BindingLayout::Buffer {
                ty: BufferKind::Uniform,
                ..
            }
        );
        is_uniform.then(|| self.least_bytes())
    }
}
