//! A plan bound to its pipelines, its resources and the host's imports.

use super::given::{ImportedResource, check_alignment, check_parameters, find_import};
use super::objects::{Objects, Part};
use super::pipelines::{Pipeline, label, name};
use super::resources::Created;
use super::samplers::{comparison_sampler, sampler};
use super::scope::{check_alive, scoped};
use super::{Pipelines, RecordError, Resources};
use crate::{Plan, PlannedBindingResource, PlannedPass, PlannedWork, Stage};

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
    ) -> Result<Self, RecordError> {
        plan.check()?;
        if !resources.fit(plan) {
            return Err(RecordError::WrongResources);
        }
        check_parameters(plan, parameters)?;
        check_alignment(plan, device.limits().min_uniform_buffer_offset_alignment)?;
        let binder = Binder {
            device,
            objects: Objects {
                plan,
                resources,
                imports: plan
                    .imports
                    .iter()
                    .map(|import| find_import(plan, &import.name, import.resource, imports))
                    .collect::<Result<_, _>>()?,
            },
            parameters,
        };
        let mut steps = Vec::with_capacity(plan.passes.len());
        for pass in &plan.passes {
            let what = label(pass);
            let pipeline = match pass.work {
                PlannedWork::Host { .. } => None,
                PlannedWork::Compute { .. } | PlannedWork::Fullscreen { .. } => {
                    Some(pipelines.get(plan, pass)?)
                }
            };
            let mut step = scoped(device, &what, || binder.step(pass, pipeline)).await??;
            if let Action::Draw { drawn, .. } = &mut step.action {
                *drawn = pipelines.drawn(plan, pass)?.cloned();
            }
            steps.push(step);
        }
        check_alive(device)?;
        let outputs = plan
            .outputs
            .iter()
            .filter_map(|output| {
                let created = resources.get(&plan.resources[output.resource])?;
                Some((output.name.clone(), created.clone()))
            })
            .collect();
        Ok(Self {
            steps,
            parameters: parameters.cloned(),
            parameter_size: u64::from(plan.parameters.size),
            uniform_alignment: device.limits().min_uniform_buffer_offset_alignment,
            bind_group: plan.bind_group,
            outputs,
        })
    }

    /// The texture behind an output of the graph that the plan created.
    #[must_use]
    pub fn output(&self, name: &str) -> Option<&wgpu::Texture> {
        self.outputs
            .iter()
            .find_map(|(output, created)| match created {
                Created::Texture(texture) if output == name => Some(texture),
                Created::Texture(_) | Created::Buffer(_) => None,
            })
    }

    /// The buffer behind an output of the graph that the plan created.
    #[must_use]
    pub fn output_buffer(&self, name: &str) -> Option<&wgpu::Buffer> {
        self.outputs
            .iter()
            .find_map(|(output, created)| match created {
                Created::Buffer(buffer) if output == name => Some(buffer),
                Created::Texture(_) | Created::Buffer(_) => None,
            })
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
    Parameters(u32),
    Sampler(wgpu::Sampler),
}

impl Binder<'_> {
    fn step(
        &self,
        pass: &PlannedPass,
        pipeline: Option<(&Pipeline, &wgpu::BindGroupLayout)>,
    ) -> Result<Step, RecordError> {
        let label = label(pass);
        let mut bind_groups = Vec::new();
        if let Some((_, layout)) = pipeline {
            for layer in 0..pass.layers {
                bind_groups.push(self.bind_group(pass, layout, layer, &label)?);
            }
        }
        let uniforms = self.uniforms(pass);
        if uniforms.len() > MOST_UNIFORMS {
            return Err(RecordError::Device {
                what: label,
                reason: format!("it has {} uniform bindings", uniforms.len()),
            });
        }
        let action = match (&pass.work, pipeline.map(|(pipeline, _)| pipeline)) {
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
            ) => {
                let part = |layer| Part {
                    layer,
                    plane,
                    level,
                };
                Action::Draw {
                    pipeline: pipeline.clone(),
                    drawn: None,
                    keeps,
                    targets: (0..pass.layers)
                        .map(|layer| self.objects.view(target, Some(part(layer))))
                        .collect::<Result<_, _>>()?,
                }
            }
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
                    .map(|&target| self.objects.view(target, Some(Part::default())))
                    .collect::<Result<_, _>>()?,
                depth: depth
                    .map(|target| self.objects.view(target, Some(Part::default())))
                    .transpose()?,
                blend: *blend,
            },
            _ => return Err(RecordError::MissingPipeline { pass: label }),
        };
        Ok(Step {
            stage: pass.stage,
            name: name(pass),
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
        let mut uniforms: Vec<(u32, Uniform)> = pass
            .bindings
            .iter()
            .filter_map(|binding| {
                let (offset, stride, count) = match binding.resource {
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
                Some((binding.binding, Uniform { offset, stride }))
            })
            .collect();
        uniforms.sort_by_key(|(binding, _)| *binding);
        uniforms.into_iter().map(|(_, uniform)| uniform).collect()
    }

    fn bind_group(
        &self,
        pass: &PlannedPass,
        layout: &wgpu::BindGroupLayout,
        layer: u32,
        label: &str,
    ) -> Result<wgpu::BindGroup, RecordError> {
        let bound = pass
            .bindings
            .iter()
            .map(|binding| {
                Ok((
                    binding.binding,
                    self.bound(&binding.resource, layer, label)?,
                ))
            })
            .collect::<Result<Vec<_>, RecordError>>()?;
        let mut entries = Vec::with_capacity(bound.len());
        for (binding, bound) in &bound {
            let resource = match bound {
                Bound::View(view) => wgpu::BindingResource::TextureView(view),
                Bound::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
                Bound::Buffer(buffer) => buffer.as_entire_binding(),
                Bound::Parameters(size) => {
                    let Some(buffer) = self.parameters else {
                        return Err(RecordError::ParameterBuffer {
                            problem: "is missing".to_owned(),
                            needed: u64::from(*size),
                        });
                    };
                    wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                        buffer,
                        offset: 0,
                        size: wgpu::BufferSize::new(u64::from(*size)),
                    })
                }
            };
            entries.push(wgpu::BindGroupEntry {
                binding: *binding,
                resource,
            });
        }
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
    ) -> Result<Bound, RecordError> {
        Ok(match *resource {
            PlannedBindingResource::Parameters { size, .. }
            | PlannedBindingResource::Regions { size, .. } => Bound::Parameters(size),
            PlannedBindingResource::Texture {
                resource,
                one_layer,
                level,
                plane,
                ..
            } => {
                let part = Part {
                    layer,
                    plane,
                    level,
                };
                Bound::View(self.objects.view(resource, one_layer.then_some(part))?)
            }
            PlannedBindingResource::StorageTexture {
                resource,
                level,
                plane,
            } => {
                let part = Part {
                    layer,
                    plane,
                    level,
                };
                Bound::View(self.objects.view(resource, Some(part))?)
            }
            PlannedBindingResource::Buffer { resource, .. } => {
                Bound::Buffer(self.objects.buffer(resource)?)
            }
            PlannedBindingResource::Sampler {
                filtering,
                anisotropy,
            } => Bound::Sampler(sampler(self.device, filtering, anisotropy, label)),
            PlannedBindingResource::ComparisonSampler { reversed } => {
                Bound::Sampler(comparison_sampler(self.device, reversed, label))
            }
        })
    }
}
