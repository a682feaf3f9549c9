//! A node's pass with its slots replaced by resources.

use super::Described;
use crate::{
    Access, BindingResource, Capabilities, GraphError, GraphErrorKind, ParameterLayout, Pass,
    PlannedBinding, PlannedBindingResource, PlannedPass, PlannedResource, PlannedWork, SampleType,
    SlotResource, TextureDesc, Work,
};

/// A resource that a pass touches.
pub(super) struct Touch {
    pub(super) resource: usize,
    pub(super) access: Access,
    /// Only the layer that the pass is recorded for.
    pub(super) one_layer: bool,
}

/// Everything a pass touches, and how.
pub(super) fn touched(pass: &PlannedPass) -> Vec<Touch> {
    let touch = |resource: usize, access: Access, one_layer: bool| Touch {
        resource,
        access,
        one_layer,
    };
    let bound =
        pass.bindings
            .iter()
            .filter_map(|binding| match binding.resource {
                PlannedBindingResource::Texture {
                    resource,
                    one_layer,
                    ..
                } => Some(touch(resource, Access::READ, one_layer)),
                PlannedBindingResource::StorageTexture { resource } => {
                    Some(touch(resource, Access::STORAGE_WRITE, true))
                }
                PlannedBindingResource::Buffer { resource, writable } => {
                    let write = Access {
                        storage_write: writable,
                        ..Access::READ
                    };
                    Some(touch(resource, write, false))
                }
                PlannedBindingResource::Parameters { .. }
                | PlannedBindingResource::Sampler { .. } => None,
            });
    let mut touched: Vec<Touch> = bound.collect();
    match &pass.work {
        PlannedWork::Compute { .. } => {}
        PlannedWork::Fullscreen { target } => {
            touched.push(touch(*target, Access::RENDER_TARGET, true));
        }
        PlannedWork::Host { targets, depth, .. } => {
            let all = targets.iter().chain(depth);
            touched.extend(all.map(|&target| touch(target, Access::RENDER_TARGET, true)));
        }
    }
    touched
}

/// Resolves a pass and records in the resources how it touches them.
pub(super) fn plan(
    node: &str,
    described: &Described,
    pass: &Pass,
    resources: &mut [PlannedResource],
    block: Option<usize>,
    parameters: &ParameterLayout,
    capabilities: &Capabilities,
) -> Result<PlannedPass, GraphError> {
    let resource = |slot: &str| {
        described.slots.get(slot).copied().ok_or_else(|| {
            declaration(format!(
                "pass '{}' uses slot '{slot}', which the node does not have",
                pass.label
            ))
        })
    };
    let texture = |slot: &str| {
        let index = resource(slot)?;
        let texture = resources[index].desc.texture().ok_or_else(|| {
            declaration(format!(
                "pass '{}' uses the buffer '{slot}' as a texture",
                pass.label
            ))
        })?;
        Ok::<(usize, &TextureDesc), GraphError>((index, texture))
    };
    let filtered = pass.bindings.iter().any(|binding| {
        matches!(
            binding.resource,
            BindingResource::Sampler { filtering: true }
        )
    });
    let mut bindings = Vec::with_capacity(pass.bindings.len());
    for binding in &pass.bindings {
        let loaded = |slot: &str, one_layer: bool| {
            let (resource, texture) = texture(slot)?;
            let filterable = capabilities.support(texture.format).filterable;
            let multisampled = texture.samples > 1;
            Ok::<_, GraphError>(PlannedBindingResource::Texture {
                resource,
                one_layer,
                sample: if texture.format.is_depth() {
                    SampleType::Depth
                } else if filterable && filtered && !multisampled {
                    SampleType::Filterable
                } else {
                    SampleType::Unfilterable
                },
                multisampled,
            })
        };
        let planned = match &binding.resource {
            BindingResource::Parameters => {
                let block = block.ok_or_else(|| {
                    declaration(format!(
                        "pass '{}' uses parameters, but the node has none",
                        pass.label
                    ))
                })?;
                PlannedBindingResource::Parameters {
                    block,
                    size: parameters.blocks[block].size,
                }
            }
            BindingResource::Layer(slot) => loaded(slot, true)?,
            BindingResource::Layers(slot) => loaded(slot, false)?,
            BindingResource::StorageLayer(slot) => PlannedBindingResource::StorageTexture {
                resource: texture(slot)?.0,
            },
            BindingResource::Buffer(slot) => PlannedBindingResource::Buffer {
                resource: resource(slot)?,
                writable: slot_access(described, slot).storage_write,
            },
            BindingResource::Sampler { filtering } => PlannedBindingResource::Sampler {
                filtering: *filtering,
            },
        };
        bindings.push(PlannedBinding {
            binding: binding.binding,
            resource: planned,
        });
    }
    let (work, layers, each_layer) = match &pass.work {
        Work::Compute {
            covers,
            texels_per_workgroup,
            each_layer,
        } => {
            let (_, covered) = texture(covers)?;
            (
                PlannedWork::Compute {
                    workgroups: workgroups(covered, *texels_per_workgroup, capabilities)
                        .map_err(|error| error.at_slot(covers))?,
                },
                covered.layers,
                *each_layer,
            )
        }
        Work::Fullscreen { target, each_layer } => {
            let (index, target) = texture(target)?;
            (
                PlannedWork::Fullscreen { target: index },
                target.layers,
                *each_layer,
            )
        }
        Work::Host {
            targets,
            blend,
            depth,
        } => (
            PlannedWork::Host {
                targets: targets
                    .iter()
                    .map(|slot| Ok(texture(slot)?.0))
                    .collect::<Result<_, GraphError>>()?,
                blend: *blend,
                depth: depth
                    .as_ref()
                    .map(|slot| Ok::<_, GraphError>(texture(slot)?.0))
                    .transpose()?,
            },
            1,
            false,
        ),
    };
    let mut planned = PlannedPass {
        node: node.to_owned(),
        label: pass.label.clone(),
        stage: described.desc.stage,
        wgsl: pass.wgsl.clone(),
        entry_point: pass.entry_point.clone(),
        constants: pass.constants.clone(),
        bindings,
        work,
        layers: if each_layer { layers } else { 1 },
        each_layer,
        bytes_read: 0,
        bytes_written: 0,
    };
    check_layers(&planned, resources)?;
    count_bytes(&mut planned, resources);
    for Touch {
        resource: index,
        access,
        ..
    } in touched(&planned)
    {
        let slot = described
            .slots
            .iter()
            .find(|(_, resource)| **resource == index);
        if let Some((slot, _)) = slot
            && !slot_access(described, slot).contains(access)
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

fn declaration(message: String) -> GraphError {
    GraphError::new(GraphErrorKind::Declaration, message)
}

fn slot_access(described: &Described, slot: &str) -> Access {
    described
        .desc
        .slots
        .iter()
        .find(|candidate| candidate.name == slot)
        .map_or(Access::default(), |slot| match &slot.resource {
            SlotResource::Texture { access, .. } | SlotResource::Buffer { access, .. } => *access,
        })
}

fn workgroups(
    covered: &TextureDesc,
    texels_per_workgroup: [u32; 2],
    capabilities: &Capabilities,
) -> Result<[u32; 2], GraphError> {
    if texels_per_workgroup.contains(&0) {
        return Err(declaration("a workgroup covers no texel".to_owned()));
    }
    let groups = [0, 1].map(|axis| covered.size[axis].div_ceil(texels_per_workgroup[axis]));
    let largest = capabilities.max_workgroups;
    if groups.iter().any(|&count| count > largest) {
        return Err(GraphError::new(
            GraphErrorKind::Size,
            format!(
                "covering {}x{} texels takes {}x{} workgroups; the device allows {largest}, so at most {}x{} texels",
                covered.size[0],
                covered.size[1],
                groups[0],
                groups[1],
                u64::from(largest) * u64::from(texels_per_workgroup[0]),
                u64::from(largest) * u64::from(texels_per_workgroup[1]),
            ),
        ));
    }
    Ok(groups)
}

/// A pass per layer needs every texture that it binds by layer to have that layer.
fn check_layers(pass: &PlannedPass, resources: &[PlannedResource]) -> Result<(), GraphError> {
    for binding in &pass.bindings {
        let resource = match &binding.resource {
            PlannedBindingResource::Texture {
                resource,
                one_layer: true,
                ..
            }
            | PlannedBindingResource::StorageTexture { resource } => *resource,
            _ => continue,
        };
        let layers = resources[resource].desc.layers();
        if layers < pass.layers {
            return Err(GraphError::new(
                GraphErrorKind::Size,
                format!(
                    "pass '{}' is recorded for {} layers, but '{}' has {layers}",
                    pass.label, pass.layers, resources[resource].name
                ),
            ));
        }
    }
    Ok(())
}

/// Every texel that a pass binds is counted once, however often the shader loads it: what has to cross the memory bus.
fn count_bytes(pass: &mut PlannedPass, resources: &[PlannedResource]) {
    let bytes = |resource: usize, by_layer: bool| match &resources[resource].desc {
        crate::ResourceDesc::Texture(texture) if by_layer => {
            texture.bytes_per_layer() * u64::from(pass.layers)
        }
        desc => desc.bytes(),
    };
    let (mut read, mut written) = (0, 0);
    for binding in &pass.bindings {
        match &binding.resource {
            PlannedBindingResource::Texture {
                resource,
                one_layer,
                ..
            } => {
                read += bytes(*resource, *one_layer);
            }
            PlannedBindingResource::StorageTexture { resource } => {
                written += bytes(*resource, true);
            }
            PlannedBindingResource::Buffer { resource, writable } => {
                read += bytes(*resource, false);
                written += if *writable {
                    bytes(*resource, false)
                } else {
                    0
                };
            }
            PlannedBindingResource::Parameters { size, .. } => {
                read += u64::from(*size) * u64::from(pass.layers);
            }
            PlannedBindingResource::Sampler { .. } => {}
        }
    }
    match &pass.work {
        PlannedWork::Compute { .. } => {}
        PlannedWork::Fullscreen { target } => written += bytes(*target, true),
        PlannedWork::Host {
            targets,
            blend,
            depth,
        } => {
            let colour: u64 = targets.iter().map(|&target| bytes(target, true)).sum();
            written += colour + depth.map_or(0, |target| bytes(target, true));
            read += if *blend { colour } else { 0 };
        }
    }
    pass.bytes_read = read;
    pass.bytes_written = written;
}
