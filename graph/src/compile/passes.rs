//! A node's pass with its slots replaced by resources.

use std::collections::BTreeMap;

use super::{Described, Known, bytes, declaration, workgroups};
use crate::error::ensure;
use crate::plan::{MOST_TARGETS, Part};
use crate::{
    Binding, BindingLayout, BindingResource, BufferKind, Capabilities, GraphError, GraphErrorKind,
    ParameterLayout, Pass, PlannedBinding, PlannedBindingResource, PlannedPart, PlannedPass,
    PlannedResource, PlannedSampler, PlannedWork, SampleType, StorageAccess, TextureDesc, Usage,
    ViewDimension, Visibility, Work,
};

/// The vertex entry point of every fullscreen pass.
pub(super) const VERTEX_ENTRY_POINT: &str = "fullscreen";

fn sampled(sampler: PlannedSampler) -> (BindingLayout, PlannedBindingResource) {
    let layout = BindingLayout::Sampler { ty: sampler.kind() };
    (layout, PlannedBindingResource::Sampler(sampler))
}

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
            let (layout, resource) = self.binding(&binding.resource)?;
            Ok(PlannedBinding {
                // The shader's declaration has it.
                binding: 0,
                name: binding.variable.clone(),
                layout,
                resource,
            })
        });
        let bindings = bindings.collect::<Result<_, GraphError>>()?;
        let (work, followed) = self.work()?;
        let followed = &self.known[followed];
        let pass = self.pass;
        let layers = followed.desc.layers();
        let layers = if pass.each_layer { layers } else { 1 };
        let mut planned = PlannedPass {
            node: self.node.to_owned(),
            label: pass.label.clone(),
            stage: self.described.desc.stage,
            // The shaders of the whole plan are collected once all bindings are known.
            shader: None,
            entry_point: pass.entry_point.clone(),
            vertex_entry_point: match work {
                PlannedWork::Fullscreen { .. } => Some(VERTEX_ENTRY_POINT.to_owned()),
                PlannedWork::Compute { .. } | PlannedWork::Host { .. } => None,
            },
            constants: pass.constants.clone(),
            visibility: match work {
                PlannedWork::Fullscreen { .. } => Some(Visibility::Fragment),
                PlannedWork::Compute { .. } => Some(Visibility::Compute),
                PlannedWork::Host { .. } => None,
            },
            bindings,
            dynamic_offsets: Vec::new(),
            reads: Vec::new(),
            writes: Vec::new(),
            after: Vec::new(),
            after_in_memory: Vec::new(),
            work,
            layers,
            each_layer: pass.each_layer,
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
            let resource = &mut resources[touch.resource];
            Usage::add(&mut resource.usage, &resource.desc, touch.access);
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

    fn binding(
        &self,
        resource: &BindingResource,
    ) -> Result<(BindingLayout, PlannedBindingResource), GraphError> {
        let loaded = |slot: &str, one_layer: bool, level: u32| {
            let (known, texture) = self.texture(slot, level)?;
            let plane = one_layer
                .then(|| self.plane(slot, texture, None))
                .transpose()?;
            let layout = BindingLayout::Texture {
                sample_type: self.sample(texture),
                view_dimension: if one_layer {
                    ViewDimension::D2
                } else {
                    ViewDimension::D2Array
                },
                multisampled: texture.samples > 1,
            };
            let resource = PlannedBindingResource::Texture {
                resource: self.indices[&known],
                part: plane.map(|plane| PlannedPart { level, plane }),
            };
            Ok((layout, resource))
        };
        // Within the limit of a uniform binding.
        let uniform = |size: u64| BindingLayout::Buffer {
            ty: BufferKind::Uniform,
            has_dynamic_offset: true,
            min_binding_size: size as u32,
        };
        match resource {
            BindingResource::Parameters => {
                let mut blocks = self.layout.blocks.iter();
                let block = blocks.position(|block| block.node == self.node);
                let block =
                    block.ok_or_else(|| self.fault("uses parameters, but the node has none"))?;
                let layout = uniform(self.layout.blocks[block].array_size());
                Ok((layout, PlannedBindingResource::Parameters { block }))
            }
            BindingResource::Regions { slot, .. } => {
                let (known, _) = self.texture(slot, 0)?;
                let map = &self.known[self.known[known].root].name;
                let mut tables = self.layout.regions.iter();
                let table = tables.position(|table| table.map == *map);
                let table = table.ok_or_else(|| {
                    self.fault(format!("uses the regions of '{slot}', which has none"))
                })?;
                let layout = uniform(self.layout.regions[table].size());
                Ok((layout, PlannedBindingResource::Regions { table }))
            }
            BindingResource::Level { slot, level } => loaded(slot, true, *level),
            BindingResource::Layers(slot) => loaded(slot, false, 0),
            BindingResource::StorageLevel { slot, level, plane } => {
                let (known, texture) = self.texture(slot, *level)?;
                let layout = BindingLayout::StorageTexture {
                    access: StorageAccess::WriteOnly,
                    format: texture.format,
                    view_dimension: ViewDimension::D2,
                };
                let part = PlannedPart {
                    level: *level,
                    plane: self.plane(slot, texture, *plane)?,
                };
                let resource = self.indices[&known];
                let resource = PlannedBindingResource::StorageTexture { resource, part };
                Ok((layout, resource))
            }
            BindingResource::Buffer(slot) => {
                let layout = BindingLayout::Buffer {
                    ty: if self.described.access(slot).storage_write {
                        BufferKind::Storage
                    } else {
                        BufferKind::ReadOnlyStorage
                    },
                    has_dynamic_offset: false,
                    min_binding_size: 0,
                };
                let resource = self.indices[&self.slot(slot)?];
                Ok((layout, PlannedBindingResource::Buffer { resource }))
            }
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
                Ok(sampled(PlannedSampler::of_texels(filtering, anisotropy)))
            }
            &BindingResource::ComparisonSampler { reversed } => {
                Ok(sampled(PlannedSampler::of_comparisons(reversed)))
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
            SampleType::Uint
        } else if self.capabilities.support(texture.format).filterable
            && texture.samples <= 1
            && self.pass.bindings.iter().any(filters)
        {
            SampleType::Float
        } else {
            SampleType::UnfilterableFloat
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
                let work = PlannedWork::Compute {
                    workgroups,
                    covers: self.indices[&known],
                    level: *level,
                    texels_per_workgroup: *texels_per_workgroup,
                    regions: (*regions && covered.regions > 1).then_some(covered.regions),
                };
                Ok((work, known))
            }
            Work::Fullscreen {
                target,
                level,
                regions,
            } => {
                let (known, texture) = self.texture(target, *level)?;
                let work = PlannedWork::Fullscreen {
                    target: self.indices[&known],
                    part: PlannedPart {
                        level: *level,
                        plane: self.plane(target, texture, None)?,
                    },
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
                let planes = targets
                    .iter()
                    .map(|slot| Ok(self.texture(slot, 0)?.1.planes));
                let planes = planes.collect::<Result<Vec<u32>, GraphError>>()?;
                if planes.windows(2).any(|pair| pair[0] != pair[1]) {
                    return Err(self.fault(
                        "draws to maps of different numbers of texture layers per layer at once",
                    ));
                }
                let count = planes.iter().map(|&planes| u64::from(planes)).sum::<u64>();
                let most = MOST_TARGETS;
                ensure(count <= most as u64, GraphErrorKind::Size, || {
                    self.fault(format!(
                        "draws to {count} targets at once; at most {most} are possible"
                    ))
                    .message
                })?;
                let work = PlannedWork::Host {
                    targets: targets
                        .iter()
                        .map(target)
                        .collect::<Result<_, GraphError>>()?,
                    planes: planes.first().copied().unwrap_or(1),
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
        let tables = bindings.filter_map(|binding| match binding.resource {
            PlannedBindingResource::Regions { table } => {
                let table = &self.layout.regions[table];
                Some((table.map.as_str(), table.layers))
            }
            // One for all layers is none by layer.
            PlannedBindingResource::Parameters { block } => {
                let block = &self.layout.blocks[block];
                (block.count > 1).then_some((block.name.as_str(), block.count))
            }
            PlannedBindingResource::Texture { .. }
            | PlannedBindingResource::StorageTexture { .. }
            | PlannedBindingResource::Buffer { .. }
            | PlannedBindingResource::Sampler(_) => None,
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

    /// The plane of a slot's texture that is named, or else the one that the pass means.
    fn plane(
        &self,
        slot: &str,
        texture: &TextureDesc,
        named: Option<u32>,
    ) -> Result<u32, GraphError> {
        let plane = named.unwrap_or(self.pass.plane);
        match texture.planes {
            1 if named.is_none() => Ok(0),
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
