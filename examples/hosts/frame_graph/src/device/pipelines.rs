//! Pipelines, by pass. They are made once: none depends on a size.

use std::collections::HashMap;

use moment_shadows_graph::{Plan, PlannedBindingResource, PlannedPass, PlannedWork};

use super::Recorder;
use super::layout::{entry, sampler};
use super::names::by_name;
use crate::error::HostError;

#[derive(Clone)]
pub(super) enum Pipeline {
    Compute(wgpu::ComputePipeline),
    Render(wgpu::RenderPipeline),
}

#[derive(Clone)]
pub(super) struct OfPass {
    pub(super) pipeline: Pipeline,
    pub(super) layout: wgpu::BindGroupLayout,
    /// By the numbers of their bindings.
    pub(super) samplers: HashMap<u32, wgpu::Sampler>,
}

/// What the passes of a plan are recorded with.
pub struct Pipelines {
    of_pass: HashMap<String, OfPass>,
}

impl Pipelines {
    pub fn of_plan(device: &wgpu::Device, plan: &Plan) -> Result<Self, HostError> {
        plan.check()?;
        let modules = plan.shaders.iter().map(|text| {
            let source = wgpu::ShaderSource::Wgsl(text.into());
            let label = None;
            device.create_shader_module(wgpu::ShaderModuleDescriptor { label, source })
        });
        let modules: Vec<wgpu::ShaderModule> = modules.collect();
        let mut of_pass = HashMap::new();
        for pass in &plan.passes {
            if let Some(shader) = pass.shader {
                let made = OfPass::new(device, plan, pass, &modules[shader])?;
                of_pass.insert(pass.name(), made);
            }
        }
        Ok(Self { of_pass })
    }

    /// What records a pass.
    #[must_use]
    pub fn recorder(
        &self,
        plan: &Plan,
        pass: &PlannedPass,
        parameters: &wgpu::Buffer,
    ) -> Option<Recorder> {
        let of_pass = self.of_pass.get(&pass.name())?;
        Some(Recorder::new(plan, pass, of_pass, parameters))
    }
}

impl OfPass {
    fn new(
        device: &wgpu::Device,
        plan: &Plan,
        pass: &PlannedPass,
        module: &wgpu::ShaderModule,
    ) -> Result<Self, HostError> {
        let name = pass.name();
        let label = Some(name.as_str());
        let entries = pass.bindings.iter().map(|binding| entry(pass, binding));
        let entries = &entries.collect::<Result<Vec<_>, _>>()?;
        let group = wgpu::BindGroupLayoutDescriptor { label, entries };
        let group = device.create_bind_group_layout(&group);
        let mut groups = vec![None; plan.bind_group as usize];
        groups.push(Some(&group));
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label,
            bind_group_layouts: &groups,
            immediate_size: 0,
        });
        let constants = pass.constants.iter();
        let constants: Vec<(&str, f64)> =
            constants.map(|(name, it)| (name.as_str(), *it)).collect();
        let compilation_options = wgpu::PipelineCompilationOptions {
            constants: &constants,
            ..Default::default()
        };
        let entry_point = Some(pass.entry_point.as_str());
        let target = match pass.work {
            PlannedWork::Fullscreen { target, .. } => plan.resources[target].desc.texture(),
            PlannedWork::Compute { .. } | PlannedWork::Host { .. } => None,
        };
        let pipeline = if let Some(target) = target {
            let format: wgpu::TextureFormat = by_name(target.format)?;
            Pipeline::Render(
                device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                    label,
                    layout: Some(&layout),
                    vertex: wgpu::VertexState {
                        module,
                        entry_point: pass.vertex_entry_point.as_deref(),
                        compilation_options: Default::default(),
                        buffers: &[],
                    },
                    fragment: Some(wgpu::FragmentState {
                        module,
                        entry_point,
                        compilation_options,
                        targets: &[Some(format.into())],
                    }),
                    primitive: Default::default(),
                    depth_stencil: None,
                    multisample: Default::default(),
                    multiview_mask: None,
                    cache: None,
                }),
            )
        } else {
            let compute = wgpu::ComputePipelineDescriptor {
                label,
                layout: Some(&layout),
                module,
                entry_point,
                compilation_options,
                cache: None,
            };
            Pipeline::Compute(device.create_compute_pipeline(&compute))
        };
        let samplers = pass
            .bindings
            .iter()
            .filter_map(|binding| match &binding.resource {
                PlannedBindingResource::Sampler(state) => {
                    Some(sampler(device, state).map(|it| (binding.binding, it)))
                }
                _ => None,
            });
        Ok(Self {
            pipeline,
            samplers: samplers.collect::<Result<_, _>>()?,
            layout: group,
        })
    }
}
