//! A plan bound to its pipelines, its resources and the host's imports.

use super::given::{ImportedResource, check_parameters, find_import};
use super::objects::Objects;
use super::pipelines::{Made, Pipeline, label, missing};
use super::samplers::sampler;
use super::scope::{check_alive, scoped};
use super::{Pipelines, Resources};
use crate::error::ensure;
use crate::plan::Part;
use crate::{
    GraphError, GraphErrorKind, Plan, PlannedBinding, PlannedBindingResource, PlannedOffset,
    PlannedPart, PlannedPass, PlannedWork, Stage,
};

/// Everything that recording needs, made beforehand.
#[derive(Debug)]
pub struct Bindings {
    pub(super) steps: Vec<Step>,
    pub(super) parameters: Option<wgpu::Buffer>,
    pub(super) parameter_size: u64,
    pub(super) uniform_alignment: u32,
    pub(super) bind_group: u32,
    /// What the plan created of the graph's outputs.
    pub(crate) outputs: Vec<(String, ImportedResource)>,
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
    pub(super) uniforms: Vec<PlannedOffset>,
    /// One per layer.
    pub(super) bind_groups: Vec<wgpu::BindGroup>,
    pub(super) action: Action,
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
        /// For a render pass of the host.
        drawn: wgpu::RenderPipeline,
        /// One per layer.
        targets: Vec<wgpu::TextureView>,
        load: wgpu::LoadOp<wgpu::Color>,
    },
    Host {
        /// For each layer the colour targets, and the depth target.
        targets: Vec<(Vec<wgpu::TextureView>, Option<wgpu::TextureView>)>,
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
        imports: &[(&str, ImportedResource)],
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
        let found = plan.imports.iter();
        let found = found.map(|import| find_import(plan, import, imports));
        let objects = Objects {
            device,
            plan,
            resources,
            imports: found.collect::<Result<_, _>>()?,
            parameters,
        };
        let mut steps = Vec::with_capacity(plan.passes.len());
        for pass in &plan.passes {
            check_workgroups(pass, device)?;
            let is_host = matches!(pass.work, PlannedWork::Host { .. });
            let made = (!is_host).then(|| pipelines.get(plan, pass)).transpose()?;
            steps.push(scoped(device, &label(pass), || objects.step(pass, made)).await??);
        }
        check_alive(device).await?;
        let outputs = plan.outputs.iter().filter_map(|output| {
            let created = resources.get(&plan.resources[output.value])?;
            Some((output.name.clone(), created.clone()))
        });
        Ok(Self {
            steps,
            parameters: parameters.cloned(),
            parameter_size: u64::from(plan.parameters.size),
            uniform_alignment,
            bind_group: plan.bind_group,
            outputs: outputs.collect(),
        })
    }

    /// The texture behind an output of the graph that the plan created.
    #[must_use]
    pub fn output(&self, name: &str) -> Option<&wgpu::Texture> {
        let mut outputs = self.outputs.iter();
        let (_, ImportedResource::Texture(texture)) = outputs.find(|it| it.0 == name)? else {
            return None;
        };
        Some(texture)
    }

    /// The buffer behind an output of the graph that the plan created.
    #[must_use]
    pub fn output_buffer(&self, name: &str) -> Option<&wgpu::Buffer> {
        let mut outputs = self.outputs.iter();
        let (_, ImportedResource::Buffer(buffer)) = outputs.find(|it| it.0 == name)? else {
            return None;
        };
        Some(buffer)
    }
}

/// Whether a device takes a dispatch: what it refuses then, it refuses where nobody waits for its verdict.
fn check_workgroups(pass: &PlannedPass, device: &wgpu::Device) -> Result<(), GraphError> {
    let PlannedWork::Compute {
        workgroups: [x, y], ..
    } = pass.work
    else {
        return Ok(());
    };
    let most = device.limits().max_compute_workgroups_per_dimension;
    ensure(x.max(y) <= most, GraphErrorKind::Capability, || {
        let label = label(pass);
        format!(
            "{label} takes {x}x{y} workgroups, but this device allows {most}; compile the graph for this device"
        )
    })
}

/// An object of a bind group, kept until the group is made.
enum Bound {
    View(wgpu::TextureView),
    /// So many bytes of a buffer; all, where `None`.
    Buffer(wgpu::Buffer, Option<wgpu::BufferSize>),
    Sampler(wgpu::Sampler),
}

impl Objects<'_> {
    fn step(&self, pass: &PlannedPass, made: Option<Made<'_>>) -> Result<Step, GraphError> {
        let label = label(pass);
        let mut bind_groups = Vec::new();
        if let Some(made) = made {
            for layer in 0..pass.layers {
                bind_groups.push(self.bind_group(pass, made.layout, layer, &label)?);
            }
        }
        let uniforms = pass.dynamic_offsets.clone();
        let count = uniforms.len();
        ensure(count <= MOST_UNIFORMS, GraphErrorKind::Plan, || {
            format!("{label} has {count} uniform bindings, more than {MOST_UNIFORMS}")
        })?;
        let whole = PlannedPart { level: 0, plane: 0 };
        let view = |target: usize, part: PlannedPart, layer| self.view(target, part.into(), layer);
        let action = match (&pass.work, made.map(|made| [made.pipeline, made.drawn])) {
            (PlannedWork::Compute { workgroups, .. }, Some([Pipeline::Compute(pipeline), _])) => {
                Action::Dispatch {
                    pipeline: pipeline.clone(),
                    workgroups: *workgroups,
                }
            }
            (
                &PlannedWork::Fullscreen {
                    target,
                    part,
                    keeps,
                },
                Some([Pipeline::Render(pipeline), Pipeline::Render(drawn)]),
            ) => Action::Draw {
                pipeline: pipeline.clone(),
                drawn: drawn.clone(),
                load: if keeps {
                    wgpu::LoadOp::Load
                } else {
                    wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT)
                },
                targets: (0..pass.layers)
                    .map(|layer| view(target, part, layer))
                    .collect::<Result<_, _>>()?,
            },
            (
                PlannedWork::Host {
                    targets: colours,
                    planes,
                    blend,
                    depth,
                },
                _,
            ) => {
                let drawn = |layer| {
                    let each = colours
                        .iter()
                        .flat_map(|&target| (0..*planes).map(move |plane| (target, plane)));
                    let each = each
                        .map(|(target, plane)| view(target, PlannedPart { plane, ..whole }, layer));
                    let depth = depth.map(|target| view(target, whole, layer)).transpose()?;
                    Ok::<_, GraphError>((each.collect::<Result<_, _>>()?, depth))
                };
                Action::Host {
                    targets: (0..pass.layers).map(drawn).collect::<Result<_, _>>()?,
                    blend: *blend,
                }
            }
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

    fn bind_group(
        &self,
        pass: &PlannedPass,
        layout: &wgpu::BindGroupLayout,
        layer: u32,
        label: &str,
    ) -> Result<wgpu::BindGroup, GraphError> {
        let bindings = pass.bindings.iter();
        let bound = bindings.map(|binding| self.bound(binding, layer, label));
        let bound = bound.collect::<Result<Vec<_>, GraphError>>()?;
        let numbers = pass.bindings.iter().map(|binding| binding.binding);
        let entries = numbers.zip(&bound).map(|(binding, bound)| {
            let resource = match bound {
                Bound::View(view) => wgpu::BindingResource::TextureView(view),
                Bound::Sampler(sampler) => wgpu::BindingResource::Sampler(sampler),
                &Bound::Buffer(ref buffer, size) => {
                    let offset = 0;
                    let binding = wgpu::BufferBinding {
                        buffer,
                        offset,
                        size,
                    };
                    wgpu::BindingResource::Buffer(binding)
                }
            };
            wgpu::BindGroupEntry { binding, resource }
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
        binding: &PlannedBinding,
        layer: u32,
        label: &str,
    ) -> Result<Bound, GraphError> {
        if let Some(size) = binding.uniform_size() {
            let buffer = self.parameters.ok_or_else(|| {
                let message =
                    format!("the parameter buffer is missing; {label} needs {size} bytes of it");
                GraphError::new(GraphErrorKind::Parameters, message)
            })?;
            let size = wgpu::BufferSize::new(u64::from(size));
            return Ok(Bound::Buffer(buffer.clone(), size));
        }
        if let PlannedBindingResource::Sampler(state) = &binding.resource {
            return Ok(Bound::Sampler(sampler(self.device, state, label)));
        }
        let touch = binding.touch().ok_or_else(|| {
            let message = format!("'{}' of {label} holds nothing", binding.name);
            GraphError::new(GraphErrorKind::Plan, message)
        })?;
        Ok(match touch {
            touch if touch.part == Part::Buffer => {
                Bound::Buffer(self.buffer(touch.resource)?, None)
            }
            touch => Bound::View(self.view(touch.resource, touch.part, layer)?),
        })
    }
}
