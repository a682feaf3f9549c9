//! A plan bound to its pipelines, its resources and the host's imports.

use super::given::{ImportedResource, check_parameters, find_import};
use super::objects::Objects;
use super::pipelines::{Made, Pipeline, label, missing};
use super::resources::Created;
use super::samplers::{comparison_sampler, sampler};
use super::scope::{check_alive, scoped};
use super::{Pipelines, Resources};
use crate::error::ensure;
use crate::plan::Part;
use crate::{
    GraphError, GraphErrorKind, Plan, PlannedBindingResource, PlannedPass, PlannedWork, Stage,
};

/// Everything that recording needs, made beforehand.
#[derive(Debug)]
pub struct Bindings {
    pub(super) steps: Vec<Step>,
    pub(super) parameters: Option<wgpu::Buffer>,
    pub(super) parameter_size: u64,
    pub(super) uniform_alignment: u32,
    pub(super) bind_group: u32,
    outputs: Vec<(String, Created)>,
}

/// A pass, ready to be recorded.
#[derive(Debug)]
pub(super) struct Step {
    pub(super) stage: Stage,
    /// `node/pass`, and the label of its objects.
    pub(super) name: String,
    pub(super) label: String,
    pub(super) each_layer: bool,
    pub(super) layers: u32,
    /// The import or resource whose layers it follows.
    pub(super) map: String,
    /// Where its uniform data lies, in the order of the bindings.
    pub(super) uniforms: Vec<Uniform>,
    /// One per layer.
    pub(super) bind_groups: Vec<wgpu::BindGroup>,
    pub(super) action: Action,
}

/// Uniform data of a pass within a view's block.
#[derive(Clone, Copy, Debug)]
pub(super) struct Uniform {
    pub(super) offset: u32,
    /// From layer to layer; 0 where there is one for all.
    pub(super) stride: u32,
}

/// A pass has its node's parameters and the regions of its map.
pub(super) const MOST_UNIFORMS: usize = 4;

#[derive(Debug)]
pub(super) enum Action {
    Dispatch {
        pipeline: wgpu::ComputePipeline,
        workgroups: [u32; 2],
    },
    Draw {
        pipeline: wgpu::RenderPipeline,
        /// For a render pass of the host that looks different.
        drawn: Option<wgpu::RenderPipeline>,
        /// One per layer.
        targets: Vec<wgpu::TextureView>,
        /// Whether they are not cleared.
        keeps: bool,
    },
    Host {
        targets: Vec<wgpu::TextureView>,
        depth: Option<wgpu::TextureView>,
        blend: bool,
    },
}

impl Bindings {
    /// Binds a plan. `parameters` is a uniform buffer of the host's with one block per view
    /// ([`crate::ParameterLayout`]); it can be left out where no node has parameters.
    ///
    /// To be made anew when an import changes, and whenever pipelines or resources do.
    pub async fn create(
        device: &wgpu::Device,
        plan: &Plan,
        pipelines: &Pipelines,
        resources: &Resources,
        imports: &[(&str, ImportedResource<'_>)],
        parameters: Option<&wgpu::Buffer>,
    ) -> Result<Self, GraphError> {
        plan.check()?;
        ensure(
            resources.fit(plan),
            GraphErrorKind::Plan,
            || "the resources were created for another plan; create them from this one",
        )?;
        let uniform_alignment = device.limits().min_uniform_buffer_offset_alignment;
        check_parameters(plan, parameters, uniform_alignment)?;
        let binder = Binder {
            device,
            objects: Objects {
                plan,
                resources,
                imports: plan
                    .imports
                    .iter()
                    .map(|import| find_import(plan, import, imports))
                    .collect::<Result<_, _>>()?,
            },
            parameters,
        };
        let mut steps = Vec::with_capacity(plan.passes.len());
        for pass in &plan.passes {
            let made = match pass.work {
                PlannedWork::Host { .. } => None,
                PlannedWork::Compute { .. } | PlannedWork::Fullscreen { .. } => {
                    Some(pipelines.get(plan, pass)?)
                }
            };
            steps.push(scoped(device, &label(pass), || binder.step(pass, made)).await??);
        }
        check_alive(device)?;
        let outputs = plan
            .outputs
            .iter()
            .filter_map(|output| {
                let created = resources.get(&plan.resources[output.value])?;
                Some((output.name.clone(), created.clone()))
            })
            .collect();
        Ok(Self {
            steps,
            parameters: parameters.cloned(),
            parameter_size: u64::from(plan.parameters.size),
            uniform_alignment,
            bind_group: plan.bind_group,
            outputs,
        })
    }

    /// The texture behind an output of the graph that the plan created.
    #[must_use]
    pub fn output(&self, name: &str) -> Option<&wgpu::Texture> {
        match self.created(name)? {
            Created::Texture(texture) => Some(texture),
            Created::Buffer(_) => None,
        }
    }

    /// The buffer behind an output of the graph that the plan created.
    #[must_use]
    pub fn output_buffer(&self, name: &str) -> Option<&wgpu::Buffer> {
        match self.created(name)? {
            Created::Texture(_) => None,
            Created::Buffer(buffer) => Some(buffer),
        }
    }

    fn created(&self, name: &str) -> Option<&Created> {
        let mut outputs = self.outputs.iter();
        let (_, created) = outputs.find(|(output, _)| output == name)?;
        Some(created)
    }
}

/// What binding a pass draws from.
struct Binder<'a> {
    device: &'a wgpu::Device,
    objects: Objects<'a>,
    parameters: Option<&'a wgpu::Buffer>,
}

/// An object of a bind group, kept until the group is made.
enum Bound {
    View(wgpu::TextureView),
    Buffer(wgpu::Buffer),
    /// So many bytes of the parameter buffer.
    Parameters(wgpu::Buffer, u32),
    Sampler(wgpu::Sampler),
}

impl Binder<'_> {
    fn step(&self, pass: &PlannedPass, made: Option<Made<'_>>) -> Result<Step, GraphError> {
        let label = label(pass);
        let mut bind_groups = Vec::new();
        if let Some(made) = made {
            for layer in 0..pass.layers {
                bind_groups.push(self.bind_group(pass, made.layout, layer, &label)?);
            }
        }
        let uniforms = self.uniforms(pass);
        ensure(
            uniforms.len() <= MOST_UNIFORMS,
            GraphErrorKind::Plan,
            || {
                format!(
                    "{label} has {} uniform bindings, more than {MOST_UNIFORMS}",
                    uniforms.len()
                )
            },
        )?;
        let view = |target: usize, level, plane, layer| {
            let part = Part::Level { level, plane };
            self.objects.view(target, part, layer)
        };
        let action = match (&pass.work, made.map(|made| made.pipeline)) {
            (PlannedWork::Compute { workgroups }, Some(Pipeline::Compute(pipeline))) => {
                Action::Dispatch {
                    pipeline: pipeline.clone(),
                    workgroups: *workgroups,
                }
            }
            (
                &PlannedWork::Fullscreen {
                    target,
                    level,
                    plane,
                    keeps,
                },
                Some(Pipeline::Render(pipeline)),
            ) => Action::Draw {
                pipeline: pipeline.clone(),
                drawn: made.and_then(|made| made.drawn).cloned(),
                keeps,
                targets: (0..pass.layers)
                    .map(|layer| view(target, level, plane, layer))
                    .collect::<Result<_, _>>()?,
            },
            (
                PlannedWork::Host {
                    targets: colours,
                    blend,
                    depth,
                },
                _,
            ) => Action::Host {
                targets: colours
                    .iter()
                    .map(|&target| view(target, 0, 0, 0))
                    .collect::<Result<_, _>>()?,
                depth: depth.map(|target| view(target, 0, 0, 0)).transpose()?,
                blend: *blend,
            },
            _ => return Err(missing(pass)),
        };
        Ok(Step {
            stage: pass.stage,
            name: pass.name(),
            label,
            each_layer: pass.each_layer,
            layers: pass.layers,
            map: pass.map.clone(),
            uniforms,
            bind_groups,
            action,
        })
    }

    /// Uniform data in the order of the bindings, which is that of dynamic offsets.
    fn uniforms(&self, pass: &PlannedPass) -> Vec<Uniform> {
        let layout = &self.objects.plan.parameters;
        // The compiler sorts bindings; a plan from elsewhere may not.
        let mut bindings: Vec<_> = pass.bindings.iter().collect();
        bindings.sort_by_key(|binding| binding.variable);
        let uniform = |resource: &PlannedBindingResource| {
            let (offset, stride, count) = match *resource {
                PlannedBindingResource::Parameters { block, .. } => {
                    let block = &layout.blocks[block];
                    (block.offset, block.stride, block.count)
                }
                PlannedBindingResource::Regions { table, .. } => {
                    let table = &layout.regions[table];
                    (table.offset, table.stride, table.layers)
                }
                PlannedBindingResource::Texture { .. }
                | PlannedBindingResource::StorageTexture { .. }
                | PlannedBindingResource::Buffer { .. }
                | PlannedBindingResource::Sampler { .. }
                | PlannedBindingResource::ComparisonSampler { .. } => return None,
            };
            let stride = if count > 1 { stride } else { 0 };
            Some(Uniform { offset, stride })
        };
        let uniforms = bindings
            .iter()
            .filter_map(|binding| uniform(&binding.resource));
        uniforms.collect()
    }

    fn bind_group(
        &self,
        pass: &PlannedPass,
        layout: &wgpu::BindGroupLayout,
        layer: u32,
        label: &str,
    ) -> Result<wgpu::BindGroup, GraphError> {
        let bindings = pass.bindings.iter();
        let bound = bindings.map(|binding| self.bound(&binding.resource, layer, label));
        let bound = bound.collect::<Result<Vec<_>, GraphError>>()?;
        let entries = pass.bindings.iter().zip(&bound).map(|(binding, bound)| {
            let resource = match bound {
                Bound::View(view) => wgpu::BindingResource::TextureView(view),
                Bound::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
                Bound::Buffer(buffer) => buffer.as_entire_binding(),
                Bound::Parameters(buffer, size) => {
                    wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                        buffer,
                        offset: 0,
                        size: wgpu::BufferSize::new(u64::from(*size)),
                    })
                }
            };
            wgpu::BindGroupEntry {
                binding: binding.variable,
                resource,
            }
        });
        let entries: Vec<wgpu::BindGroupEntry<'_>> = entries.collect();
        Ok(self.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(label),
            layout,
            entries: &entries,
        }))
    }

    fn bound(
        &self,
        resource: &PlannedBindingResource,
        layer: u32,
        label: &str,
    ) -> Result<Bound, GraphError> {
        let view = |resource, part| Ok(Bound::View(self.objects.view(resource, part, layer)?));
        match *resource {
            PlannedBindingResource::Parameters { size, .. }
            | PlannedBindingResource::Regions { size, .. } => match self.parameters {
                Some(buffer) => Ok(Bound::Parameters(buffer.clone(), size)),
                None => Err(GraphError::new(
                    GraphErrorKind::Parameters,
                    format!("the parameter buffer is missing; {label} needs {size} bytes of it"),
                )),
            },
            PlannedBindingResource::Texture {
                resource,
                one_layer,
                level,
                plane,
                ..
            } => {
                let part = if one_layer {
                    Part::Level { level, plane }
                } else {
                    Part::Layers
                };
                view(resource, part)
            }
            PlannedBindingResource::StorageTexture {
                resource,
                level,
                plane,
            } => view(resource, Part::Level { level, plane }),
            PlannedBindingResource::Buffer { resource, .. } => {
                Ok(Bound::Buffer(self.objects.buffer(resource)?))
            }
            PlannedBindingResource::Sampler {
                filtering,
                anisotropy,
            } => Ok(Bound::Sampler(sampler(
                self.device,
                filtering,
                anisotropy,
                label,
            ))),
            PlannedBindingResource::ComparisonSampler { reversed } => Ok(Bound::Sampler(
                comparison_sampler(self.device, reversed, label),
            )),
        }
    }
}
