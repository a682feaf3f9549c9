//! Whether a plan that was read from elsewhere holds together.

use super::{Plan, PlannedBindingResource, PlannedPass, PlannedWork};
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
        /// What it refers to.
        of: &'static str,
        /// The number.
        index: usize,
        /// How many there are.
        count: usize,
    },
    /// A texture where a buffer is needed, or a buffer where a texture is.
    #[error("{what} refers to resource '{resource}', which is {desc}; compile the graph again")]
    Kind {
        /// What refers.
        what: String,
        /// The resource's name.
        resource: String,
        /// What it is.
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
        let count = self.resources.len();
        for import in &self.imports {
            within(
                format!("import '{}'", import.name),
                "resource",
                import.resource,
                count,
            )?;
        }
        for output in &self.outputs {
            within(
                format!("output '{}'", output.name),
                "resource",
                output.resource,
                count,
            )?;
        }
        for block in &self.parameters.blocks {
            let last = u64::from(block.count.saturating_sub(1));
            let end = u64::from(block.offset) + last * u64::from(block.stride) + block.array_size();
            if end > u64::from(self.parameters.size) || block.initial.len() > block.size as usize {
                return Err(PlanError::Parameters {
                    node: block.node.clone(),
                });
            }
        }
        for table in &self.parameters.regions {
            let last = u64::from(table.layers.saturating_sub(1));
            let end = u64::from(table.offset) + last * u64::from(table.stride) + table.size();
            if end > u64::from(self.parameters.size) || table.capacity == 0 {
                return Err(PlanError::Regions {
                    map: table.map.clone(),
                });
            }
        }
        self.passes
            .iter()
            .try_for_each(|pass| self.check_pass(pass))
    }

    fn check_pass(&self, pass: &PlannedPass) -> Result<(), PlanError> {
        let what = || format!("pass '{}/{}'", pass.node, pass.label);
        for binding in &pass.bindings {
            match binding.resource {
                PlannedBindingResource::Parameters { block, .. } => {
                    within(
                        what(),
                        "parameter block",
                        block,
                        self.parameters.blocks.len(),
                    )?;
                }
                PlannedBindingResource::Regions { table, .. } => {
                    within(what(), "region table", table, self.parameters.regions.len())?;
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
                } => {
                    self.check_kind(what(), resource, true)?;
                    self.check_level(what(), resource, level)?;
                    self.check_plane(what(), resource, plane)?;
                }
                PlannedBindingResource::Buffer { resource, .. } => {
                    self.check_kind(what(), resource, false)?;
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
            } => {
                self.check_kind(what(), *target, true)?;
                self.check_level(what(), *target, *level)?;
                self.check_plane(what(), *target, *plane)
            }
            PlannedWork::Host { targets, depth, .. } => targets
                .iter()
                .chain(depth)
                .try_for_each(|&target| self.check_kind(what(), target, true)),
        }
    }

    fn check_plane(&self, what: String, index: usize, plane: u32) -> Result<(), PlanError> {
        let texture = self.resources.get(index);
        let planes = texture
            .and_then(|resource| resource.desc.texture())
            .map_or(1, |texture| texture.planes);
        within(what, "plane", plane as usize, planes as usize)
    }

    fn check_level(&self, what: String, index: usize, level: u32) -> Result<(), PlanError> {
        let texture = self
            .resources
            .get(index)
            .and_then(|resource| Some((&resource.name, resource.desc.texture()?)));
        match texture {
            Some((name, texture)) if level >= texture.mips => Err(PlanError::Level {
                what,
                level,
                resource: name.clone(),
                count: texture.mips,
            }),
            _ => Ok(()),
        }
    }

    fn check_kind(&self, what: String, index: usize, texture: bool) -> Result<(), PlanError> {
        match self.resources.get(index) {
            None => within(what, "resource", index, self.resources.len()),
            Some(resource) if resource.desc.texture().is_some() == texture => Ok(()),
            Some(resource) => Err(PlanError::Kind {
                what,
                resource: resource.name.clone(),
                desc: resource.desc.to_string(),
            }),
        }
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
