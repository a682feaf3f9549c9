//! Whether a plan that was read from elsewhere holds together.

use super::{Plan, PlannedBindingResource, PlannedPass, PlannedResource, PlannedWork};
use crate::{Home, VERSION};

/// Why a plan cannot be used. A plan that [`crate::compile`] gave is never refused; one that was read from a file may be.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// A plan of another version.
    #[error(
        "the plan has version {version}, this library reads version {VERSION}; compile the graph with this library"
    )]
    Version {
        /// The plan's version.
        version: u32,
    },
    /// A number that refers to nothing in the plan.
    #[error("{what} refers to {of} {index}, but the plan has {count}; compile the graph again")]
    Index {
        /// What refers.
        what: String,
        /// The kind of thing that it refers to.
        of: &'static str,
        /// The number.
        index: usize,
        /// How many of these the plan has.
        count: usize,
    },
    /// A texture where a buffer is needed, or a buffer where a texture is.
    #[error("{what} refers to resource '{resource}', which is {desc}; compile the graph again")]
    Kind {
        /// What refers.
        what: String,
        /// The resource's name.
        resource: String,
        /// What the resource is.
        desc: String,
    },
    /// A map's regions that do not lie within the view's block.
    #[error("the regions of map '{map}' do not lie within a view's block; compile the graph again")]
    Regions {
        /// The map.
        map: String,
    },
    /// A mip level that a texture does not have.
    #[error(
        "{what} refers to mip level {level} of '{resource}', which has {count}; compile the graph again"
    )]
    Level {
        /// What refers.
        what: String,
        /// The mip level.
        level: u32,
        /// The resource's name.
        resource: String,
        /// How many mip levels it has.
        count: u32,
    },
    /// A node's parameters that do not lie within the view's block.
    #[error(
        "the parameters of node '{node}' do not lie within a view's block; compile the graph again"
    )]
    Parameters {
        /// The node.
        node: String,
    },
}

impl Plan {
    /// Whether everything that the plan refers to is there. The recorder asks this before it uses a plan.
    pub fn check(&self) -> Result<(), PlanError> {
        if self.version != VERSION {
            return Err(PlanError::Version {
                version: self.version,
            });
        }
        for resource in &self.resources {
            let what = format!("resource '{}'", resource.name);
            match resource.home {
                Home::Import(index) => within(what, "import", index, self.imports.len())?,
                Home::Memory(index) => within(what, "memory", index, self.memory.len())?,
            }
        }
        let named = self.imports.iter().map(|import| ("import", import));
        let named = named.chain(self.outputs.iter().map(|output| ("output", output)));
        for (kind, named) in named {
            let what = format!("{kind} '{}'", named.name);
            within(what, "resource", named.resource, self.resources.len())?;
        }
        // Whether `count` pieces lie within a view's block.
        let fits = |offset: u32, count: u32, stride: u32, size: u64| {
            let last = u64::from(count.saturating_sub(1));
            u64::from(offset) + last * u64::from(stride) + size <= u64::from(self.parameters.size)
        };
        for block in &self.parameters.blocks {
            let inside = fits(block.offset, block.count, block.stride, block.array_size());
            if !inside || block.initial.len() > block.size as usize {
                return Err(PlanError::Parameters {
                    node: block.node.clone(),
                });
            }
        }
        for table in &self.parameters.regions {
            let inside = fits(table.offset, table.layers, table.stride, table.size());
            if !inside || table.capacity == 0 {
                return Err(PlanError::Regions {
                    map: table.map.clone(),
                });
            }
        }
        let mut passes = self.passes.iter();
        passes.try_for_each(|pass| self.check_pass(pass))
    }

    fn check_pass(&self, pass: &PlannedPass) -> Result<(), PlanError> {
        let what = || format!("pass '{}/{}'", pass.node, pass.label);
        let within = |of, index, count| within(what(), of, index, count);
        for binding in &pass.bindings {
            match binding.resource {
                PlannedBindingResource::Parameters { block, .. } => {
                    within("parameter block", block, self.parameters.blocks.len())?;
                }
                PlannedBindingResource::Regions { table, .. } => {
                    within("region table", table, self.parameters.regions.len())?;
                }
                PlannedBindingResource::Texture {
                    resource,
                    level,
                    plane,
                    ..
                }
                | PlannedBindingResource::StorageTexture {
                    resource,
                    level,
                    plane,
                } => self.check_texture(what(), resource, level, plane)?,
                PlannedBindingResource::Buffer { resource, .. } => {
                    within("resource", resource, self.resources.len())?;
                    let buffer = &self.resources[resource];
                    if buffer.desc.texture().is_some() {
                        return Err(kind(what(), buffer));
                    }
                }
                PlannedBindingResource::Sampler { .. }
                | PlannedBindingResource::ComparisonSampler { .. } => {}
            }
        }
        match &pass.work {
            PlannedWork::Compute { .. } => Ok(()),
            PlannedWork::Fullscreen {
                target,
                level,
                plane,
                ..
            } => self.check_texture(what(), *target, *level, *plane),
            PlannedWork::Host { targets, depth, .. } => targets
                .iter()
                .chain(depth)
                .try_for_each(|&target| self.check_texture(what(), target, 0, 0)),
        }
    }

    fn check_texture(
        &self,
        what: String,
        index: usize,
        level: u32,
        plane: u32,
    ) -> Result<(), PlanError> {
        let Some(resource) = self.resources.get(index) else {
            return within(what, "resource", index, self.resources.len());
        };
        let Some(texture) = resource.desc.texture() else {
            return Err(kind(what, resource));
        };
        if level >= texture.mips {
            return Err(PlanError::Level {
                what,
                level,
                resource: resource.name.clone(),
                count: texture.mips,
            });
        }
        within(what, "plane", plane as usize, texture.planes as usize)
    }
}

fn kind(what: String, resource: &PlannedResource) -> PlanError {
    PlanError::Kind {
        what,
        resource: resource.name.clone(),
        desc: resource.desc.to_string(),
    }
}

fn within(what: String, of: &'static str, index: usize, count: usize) -> Result<(), PlanError> {
    if index < count {
        return Ok(());
    }
    Err(PlanError::Index {
        what,
        of,
        index,
        count,
    })
}
