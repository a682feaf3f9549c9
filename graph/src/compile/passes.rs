//! A node's pass with its slots replaced by resources.

use std::collections::BTreeMap;

use super::{Described, Known, bytes, declaration, workgroups};
use crate::plan::Part;
use crate::{
    Binding, BindingResource, Capabilities, GraphError, GraphErrorKind, ParameterLayout, Pass,
    PlannedBindingResource, PlannedPass, PlannedResource, PlannedWork, SampleType, TextureDesc,
    Work,
};

/// What a node's pass is resolved with.
pub(super) struct Planner<'a> {
    pub(super) node: &'a str,
    pub(super) described: &'a Described,
    pub(super) pass: &'a Pass,
    pub(super) known: &'a [Known],
    /// The plan's index of each known resource that passes touch.
    pub(super) indices: &'a BTreeMap<usize, usize>,
    pub(super) layout: &'a ParameterLayout,
    pub(super) capabilities: &'a Capabilities,
}

impl Planner<'_> {
    /// Resolves a pass and records in the plan's resources how it touches them.
    pub(super) fn plan(
        &self,
        resources: &mut [PlannedResource],
    ) -> Result<PlannedPass, GraphError> {
        let bindings = self.pass.bindings.iter().map(|binding| {
            Ok(Binding {
                // The shader's declaration has it.
                variable: 0,
                resource: self.binding(&binding.resource)?,
            })
        });
        let bindings = bindings.collect::<Result<_, GraphError>>()?;
        let (work, followed) = self.work()?;
        let followed = &self.known[followed];
        let pass = self.pass;
        let each_layer = pass.each_layer && !matches!(work, PlannedWork::Host { .. });
        let layers = followed.desc.layers();
        let layers = if each_layer { layers } else { 1 };
        let mut planned = PlannedPass {
            node: self.node.to_owned(),
            label: pass.label.clone(),
            stage: self.described.desc.stage,
            wgsl: pass.wgsl.clone(),
            entry_point: pass.entry_point.clone(),
            constants: pass.constants.clone(),
            bindings,
            work,
            layers,
            each_layer,
            map: self.known[followed.root].name.clone(),
            bytes_read: 0,
            bytes_written: 0,
        };
        self.check_layers(&planned, resources)?;
        bytes::count(&mut planned, resources);
        let slots = &self.described.slots;
        for touch in planned.touches() {
            let touches = |known: &usize| self.indices.get(known) == Some(&touch.resource);
            if let Some((slot, _)) = slots.iter().find(|(_, known)| touches(known))
                && !self.described.access(slot).contains(touch.access)
            {
                let fault = self.fault("does more with this slot than its declared access allows");
                return Err(fault.at_slot(slot));
            }
            let access = &mut resources[touch.resource].access;
            *access = access.union(touch.access);
        }
        Ok(planned)
    }

    fn slot(&self, slot: &str) -> Result<usize, GraphError> {
        let known = self.described.slots.get(slot).copied();
        known.ok_or_else(|| self.fault(format!("uses slot '{slot}', which the node does not have")))
    }

    /// The texture behind a slot, which has to have this mip level.
    fn texture(&self, slot: &str, level: u32) -> Result<(usize, &TextureDesc), GraphError> {
        let index = self.slot(slot)?;
        let texture = self.known[index].desc.texture();
        let texture =
            texture.ok_or_else(|| self.fault(format!("uses the buffer '{slot}' as a texture")))?;
        if level < texture.mips {
            return Ok((index, texture));
        }
        let mips = texture.mips;
        let what = format!("uses mip level {level} of '{slot}', which has {mips}");
        Err(self.fault(what).at_slot(slot))
    }

    fn binding(&self, resource: &BindingResource) -> Result<PlannedBindingResource, GraphError> {
        let loaded = |slot: &str, one_layer: bool, level: u32| {
            let (known, texture) = self.texture(slot, level)?;
            let plane = one_layer.then(|| self.plane(slot, texture)).transpose()?;
            Ok(PlannedBindingResource::Texture {
                resource: self.indices[&known],
                one_layer,
                level,
                plane: plane.unwrap_or(0),
                sample: self.sample(texture),
                multisampled: texture.samples > 1,
            })
        };
        match resource {
            BindingResource::Parameters => {
                let mut blocks = self.layout.blocks.iter();
                let block = blocks.position(|block| block.node == self.node);
                let block =
                    block.ok_or_else(|| self.fault("uses parameters, but the node has none"))?;
                // Within the limit of a uniform binding.
                let size = self.layout.blocks[block].array_size() as u32;
                Ok(PlannedBindingResource::Parameters { block, size })
            }
            BindingResource::Regions { slot, .. } => {
                let (known, _) = self.texture(slot, 0)?;
                let map = &self.known[self.known[known].root].name;
                let mut tables = self.layout.regions.iter();
                let table = tables.position(|table| table.map == *map);
                let table = table.ok_or_else(|| {
                    self.fault(format!("uses the regions of '{slot}', which has none"))
                })?;
                let size = self.layout.regions[table].size() as u32;
                Ok(PlannedBindingResource::Regions { table, size })
            }
            BindingResource::Level { slot, level } => loaded(slot, true, *level),
            BindingResource::Layers(slot) => loaded(slot, false, 0),
            BindingResource::StorageLevel { slot, level } => {
                let (known, texture) = self.texture(slot, *level)?;
                Ok(PlannedBindingResource::StorageTexture {
                    resource: self.indices[&known],
                    level: *level,
                    plane: self.plane(slot, texture)?,
                })
            }
            BindingResource::Buffer(slot) => Ok(PlannedBindingResource::Buffer {
                resource: self.indices[&self.slot(slot)?],
                writable: self.described.access(slot).storage_write,
            }),
            &BindingResource::Sampler {
                filtering,
                anisotropy,
            } => {
                if (anisotropy > 1 && !filtering) || !(1..=16).contains(&anisotropy) {
                    let what = format!(
                        "has a sampler with an anisotropy of {anisotropy}; it is from 1 to 16, and above 1 the sampler filters"
                    );
                    return Err(self.fault(what));
                }
                Ok(PlannedBindingResource::Sampler {
                    filtering,
                    anisotropy,
                })
            }
            &BindingResource::ComparisonSampler { reversed } => {
                Ok(PlannedBindingResource::ComparisonSampler { reversed })
            }
        }
    }

    /// What a pass gets when it loads from a texture.
    fn sample(&self, texture: &TextureDesc) -> SampleType {
        let filters = |binding: &Binding| {
            matches!(
                binding.resource,
                BindingResource::Sampler {
                    filtering: true,
                    ..
                }
            )
        };
        if texture.format.is_depth() {
            SampleType::Depth
        } else if texture.format.is_integer() {
            SampleType::Integer
        } else if self.capabilities.support(texture.format).filterable
            && texture.samples <= 1
            && self.pass.bindings.iter().any(filters)
        {
            SampleType::Filterable
        } else {
            SampleType::Unfilterable
        }
    }

    /// The work of a pass, and the resource whose layers it follows.
    fn work(&self) -> Result<(PlannedWork, usize), GraphError> {
        match &self.pass.work {
            Work::Compute {
                covers,
                level,
                texels_per_workgroup,
                regions,
            } => {
                let (known, covered) = self.texture(covers, *level)?;
                let workgroups = workgroups::for_regions(
                    covered.size_at(*level),
                    if *regions { covered.regions } else { 1 },
                    *texels_per_workgroup,
                    self.capabilities,
                )
                .map_err(|error| error.at_slot(covers))?;
                Ok((PlannedWork::Compute { workgroups }, known))
            }
            Work::Fullscreen {
                target,
                level,
                regions,
            } => {
                let (known, texture) = self.texture(target, *level)?;
                let work = PlannedWork::Fullscreen {
                    target: self.indices[&known],
                    level: *level,
                    plane: self.plane(target, texture)?,
                    keeps: *regions,
                };
                Ok((work, known))
            }
            Work::Host {
                targets,
                blend,
                depth,
            } => {
                let mut drawn = targets.iter().chain(depth);
                let first = drawn.next();
                let first = first.ok_or_else(|| self.fault("draws to nothing"))?;
                let target = |slot: &String| Ok(self.indices[&self.texture(slot, 0)?.0]);
                let work = PlannedWork::Host {
                    targets: targets
                        .iter()
                        .map(target)
                        .collect::<Result<_, GraphError>>()?,
                    blend: *blend,
                    depth: depth.as_ref().map(target).transpose()?,
                };
                Ok((work, self.slot(first)?))
            }
        }
    }

    /// A pass per layer needs everything that it binds by layer to have that layer.
    fn check_layers(
        &self,
        pass: &PlannedPass,
        resources: &[PlannedResource],
    ) -> Result<(), GraphError> {
        let by_layer = |part| matches!(part, Part::Level { .. });
        let touches = pass.touches().into_iter();
        let textures = touches.filter(|touch| by_layer(touch.part)).map(|touch| {
            let resource = &resources[touch.resource];
            (resource.name.as_str(), resource.desc.layers())
        });
        let bindings = pass.bindings.iter();
        let tables = bindings.filter_map(|binding| {
            let PlannedBindingResource::Regions { table, .. } = binding.resource else {
                return None;
            };
            let table = &self.layout.regions[table];
            Some((table.map.as_str(), table.layers))
        });
        let mut all = textures.chain(tables);
        match all.find(|(_, layers)| *layers < pass.layers) {
            None => Ok(()),
            Some((name, layers)) => Err(GraphError::new(
                GraphErrorKind::Size,
                format!(
                    "pass '{}' is recorded for {} layers, but '{name}' has {layers}",
                    pass.label, pass.layers
                ),
            )),
        }
    }

    /// The plane that the pass means of a slot's texture.
    fn plane(&self, slot: &str, texture: &TextureDesc) -> Result<u32, GraphError> {
        let plane = self.pass.plane;
        match texture.planes {
            1 => Ok(0),
            planes if plane < planes => Ok(plane),
            planes => {
                let what = format!("uses plane {plane} of '{slot}', which has {planes}");
                Err(self.fault(what).at_slot(slot))
            }
        }
    }

    /// The pass contradicts its node.
    fn fault(&self, what: impl core::fmt::Display) -> GraphError {
        declaration(format!("pass '{}' {what}", self.pass.label))
    }
}
