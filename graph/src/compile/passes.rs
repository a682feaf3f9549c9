//! A node's pass with its slots replaced by resources.

use super::parameters::Places;
use super::touch::{Touch, touched};
use super::work::Resolved;
use super::{Described, bytes, declaration};
use crate::{
    Access, BindingResource, Capabilities, GraphError, GraphErrorKind, MipLevel, Pass,
    PlannedBinding, PlannedBindingResource, PlannedPass, PlannedResource, SampleType, TextureDesc,
};

/// What a node's passes are resolved with.
pub(super) struct Planner<'a> {
    pub(super) node: &'a str,
    pub(super) described: &'a Described,
    pub(super) places: &'a Places,
    /// For each resource the one whose layers and regions it follows.
    pub(super) roots: &'a [usize],
    pub(super) capabilities: &'a Capabilities,
}

impl Planner<'_> {
    /// Resolves a pass and records in the resources how it touches them.
    pub(super) fn plan(
        &self,
        pass: &Pass,
        resources: &mut [PlannedResource],
    ) -> Result<PlannedPass, GraphError> {
        let filtered = pass.bindings.iter().any(|binding| {
            matches!(
                binding.resource,
                BindingResource::Sampler {
                    filtering: true,
                    ..
                }
            )
        });
        let bindings = pass
            .bindings
            .iter()
            .map(|binding| {
                Ok(PlannedBinding {
                    // The shader's declaration has it.
                    binding: 0,
                    resource: self.binding(pass, &binding.resource, filtered, resources)?,
                })
            })
            .collect::<Result<Vec<_>, GraphError>>()?;
        let Resolved {
            work,
            followed,
            layers,
            each_layer,
        } = self.work(pass, resources)?;
        let mut planned = PlannedPass {
            node: self.node.to_owned(),
            label: pass.label.clone(),
            stage: self.described.desc.stage,
            wgsl: pass.wgsl.clone(),
            entry_point: pass.entry_point.clone(),
            constants: pass.constants.clone(),
            bindings,
            work,
            layers: if each_layer { layers } else { 1 },
            each_layer,
            map: resources[self.roots[followed]].name.clone(),
            bytes_read: 0,
            bytes_written: 0,
        };
        self.check_layers(&planned, resources)?;
        bytes::count(&mut planned, resources);
        for Touch {
            resource: index,
            access,
            ..
        } in touched(&planned)
        {
            let slots = &self.described.slots;
            let slot = slots.iter().find(|(_, resource)| **resource == index);
            if let Some((slot, _)) = slot
                && !self.slot_access(slot).contains(access)
            {
                return Err(declaration(format!(
                    "pass '{}' does more with this slot than its declared access allows",
                    pass.label
                ))
                .at_slot(slot));
            }
            resources[index].access = resources[index].access.union(access);
        }
        Ok(planned)
    }

    fn resource(&self, pass: &Pass, slot: &str) -> Result<usize, GraphError> {
        self.described.slots.get(slot).copied().ok_or_else(|| {
            declaration(format!(
                "pass '{}' uses slot '{slot}', which the node does not have",
                pass.label
            ))
        })
    }

    pub(super) fn texture<'r>(
        &self,
        pass: &Pass,
        slot: &str,
        resources: &'r [PlannedResource],
    ) -> Result<(usize, &'r TextureDesc), GraphError> {
        let index = self.resource(pass, slot)?;
        let texture = resources[index].desc.texture().ok_or_else(|| {
            declaration(format!(
                "pass '{}' uses the buffer '{slot}' as a texture",
                pass.label
            ))
        })?;
        Ok((index, texture))
    }

    /// The same, for a mip level that the texture has to have.
    pub(super) fn level<'r>(
        &self,
        pass: &Pass,
        slot: &str,
        level: u32,
        resources: &'r [PlannedResource],
    ) -> Result<(usize, &'r TextureDesc), GraphError> {
        let (index, texture) = self.texture(pass, slot, resources)?;
        if level < texture.mips {
            return Ok((index, texture));
        }
        Err(declaration(format!(
            "pass '{}' uses mip level {level} of '{slot}', which has {}",
            pass.label, texture.mips
        ))
        .at_slot(slot))
    }

    fn binding(
        &self,
        pass: &Pass,
        resource: &BindingResource,
        filtered: bool,
        resources: &[PlannedResource],
    ) -> Result<PlannedBindingResource, GraphError> {
        let loaded = |slot: &str, one_layer: bool, level: u32| {
            let (resource, texture) = self.level(pass, slot, level, resources)?;
            let filterable = self.capabilities.support(texture.format).filterable;
            let multisampled = texture.samples > 1;
            Ok::<_, GraphError>(PlannedBindingResource::Texture {
                resource,
                one_layer,
                level,
                plane: if one_layer {
                    plane(pass, slot, texture)?
                } else {
                    0
                },
                sample: if texture.format.is_depth() {
                    SampleType::Depth
                } else if texture.format.is_integer() {
                    SampleType::Integer
                } else if filterable && filtered && !multisampled {
                    SampleType::Filterable
                } else {
                    SampleType::Unfilterable
                },
                multisampled,
            })
        };
        let stored = |slot: &str, level: u32| {
            let (resource, texture) = self.level(pass, slot, level, resources)?;
            Ok::<_, GraphError>(PlannedBindingResource::StorageTexture {
                resource,
                level,
                plane: plane(pass, slot, texture)?,
            })
        };
        match resource {
            BindingResource::Parameters => {
                let block = self
                    .places
                    .blocks
                    .get(&self.described.node)
                    .ok_or_else(|| {
                        declaration(format!(
                            "pass '{}' uses parameters, but the node has none",
                            pass.label
                        ))
                    })?;
                let size = self.places.layout.blocks[*block].array_size();
                Ok(PlannedBindingResource::Parameters {
                    block: *block,
                    // Within the limit of a uniform binding.
                    size: size as u32,
                })
            }
            BindingResource::Regions(asked) => {
                let (index, _) = self.texture(pass, &asked.slot, resources)?;
                let table = self.places.tables.get(&self.roots[index]).ok_or_else(|| {
                    declaration(format!(
                        "pass '{}' uses the regions of '{}', which has none",
                        pass.label, asked.slot
                    ))
                })?;
                Ok(PlannedBindingResource::Regions {
                    table: *table,
                    size: self.places.layout.regions[*table].size() as u32,
                })
            }
            BindingResource::Level(MipLevel { slot, level }) => loaded(slot, true, *level),
            BindingResource::Layers(slot) => loaded(slot, false, 0),
            BindingResource::StorageLevel(MipLevel { slot, level }) => stored(slot, *level),
            BindingResource::Buffer(slot) => Ok(PlannedBindingResource::Buffer {
                resource: self.resource(pass, slot)?,
                writable: self.slot_access(slot).storage_write,
            }),
            BindingResource::Sampler {
                filtering,
                anisotropy,
            } => {
                if (*anisotropy > 1 && !filtering) || !(1..=16).contains(anisotropy) {
                    return Err(declaration(format!(
                        "pass '{}' has a sampler with an anisotropy of {anisotropy}; it is from 1 to 16, and above 1 the \
                         sampler filters",
                        pass.label
                    )));
                }
                Ok(PlannedBindingResource::Sampler {
                    filtering: *filtering,
                    anisotropy: *anisotropy,
                })
            }
            BindingResource::ComparisonSampler { reversed } => {
                Ok(PlannedBindingResource::ComparisonSampler {
                    reversed: *reversed,
                })
            }
        }
    }

    /// A pass per layer needs every texture that it binds by layer to have that layer.
    fn check_layers(
        &self,
        pass: &PlannedPass,
        resources: &[PlannedResource],
    ) -> Result<(), GraphError> {
        for binding in &pass.bindings {
            let (name, layers) = match &binding.resource {
                PlannedBindingResource::Texture {
                    resource,
                    one_layer: true,
                    ..
                }
                | PlannedBindingResource::StorageTexture { resource, .. } => (
                    &resources[*resource].name,
                    resources[*resource].desc.layers(),
                ),
                PlannedBindingResource::Regions { table, .. } => {
                    let table = &self.places.layout.regions[*table];
                    (&table.map, table.layers)
                }
                _ => continue,
            };
            if layers < pass.layers {
                return Err(GraphError::new(
                    GraphErrorKind::Size,
                    format!(
                        "pass '{}' is recorded for {} layers, but '{name}' has {layers}",
                        pass.label, pass.layers
                    ),
                ));
            }
        }
        Ok(())
    }

    fn slot_access(&self, slot: &str) -> Access {
        let slots = &self.described.desc.slots;
        slots
            .iter()
            .find(|candidate| candidate.name == slot)
            .map_or(Access::default(), |slot| slot.resource.access())
    }
}

/// The plane that a pass means of a slot's texture.
pub(super) fn plane(pass: &Pass, slot: &str, texture: &TextureDesc) -> Result<u32, GraphError> {
    match texture.planes {
        1 => Ok(0),
        planes if pass.plane < planes => Ok(pass.plane),
        planes => Err(declaration(format!(
            "pass '{}' uses plane {} of '{slot}', which has {planes}",
            pass.label, pass.plane
        ))
        .at_slot(slot)),
    }
}
