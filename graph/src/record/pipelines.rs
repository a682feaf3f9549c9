//! Pipelines, one per distinct shader text, constants and formats.

use std::collections::HashMap;

use super::RecordError;
use super::format::texture_format;
use super::layout::LayoutKey;
use super::scope::{check_alive, scoped};
use crate::{Plan, PlannedPass, PlannedWork};

/// How pipelines are made.
#[derive(Clone, Copy, Debug, Default)]
pub struct PipelineOptions<'a> {
    /// A cache of compiled shaders that the host keeps.
    pub cache: Option<&'a wgpu::PipelineCache>,
}

/// Every pipeline that one or more plans need. Made once; a change of sizes needs no new one.
#[derive(Debug, Default)]
pub struct Pipelines {
    layouts: HashMap<LayoutKey, wgpu::BindGroupLayout>,
    pipelines: HashMap<PipelineKey, Pipeline>,
}

/// What a pipeline depends on.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct PipelineKey {
    wgsl: String,
    entry_point: String,
    /// Bit patterns, so that the key can be compared and hashed.
    constants: Vec<(String, u64)>,
    layout: LayoutKey,
    target: Option<wgpu::TextureFormat>,
    bind_group: u32,
}

#[derive(Clone, Debug)]
pub(super) enum Pipeline {
    Compute(wgpu::ComputePipeline),
    Render(wgpu::RenderPipeline),
}

impl Pipelines {
    /// The pipelines of a plan. May be called long before the first frame.
    pub async fn create(
        device: &wgpu::Device,
        plan: &Plan,
        options: PipelineOptions<'_>,
    ) -> Result<Self, RecordError> {
        let mut pipelines = Self::default();
        pipelines.extend(device, plan, options).await?;
        Ok(pipelines)
    }

    /// Adds the pipelines that a further plan needs, and says how many were made: none where only sizes differ.
    pub async fn extend(
        &mut self,
        device: &wgpu::Device,
        plan: &Plan,
        options: PipelineOptions<'_>,
    ) -> Result<usize, RecordError> {
        plan.check()?;
        check_alive(device)?;
        let mut made = 0;
        for pass in &plan.passes {
            if matches!(pass.work, PlannedWork::Host { .. }) {
                continue;
            }
            let label = label(pass);
            let key = PipelineKey::of(plan, pass, &label)?;
            if !self.layouts.contains_key(&key.layout) {
                let layout = scoped(device, &label, || key.layout.create(device, &label)).await?;
                self.layouts.insert(key.layout.clone(), layout);
            }
            if self.pipelines.contains_key(&key) {
                continue;
            }
            let pipeline = scoped(device, &label, || {
                key.create(device, &label, self.layouts.get(&key.layout), pass, options)
            })
            .await?;
            check_alive(device)?;
            self.pipelines.insert(key, pipeline);
            made += 1;
        }
        Ok(made)
    }

    /// How many pipelines there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.pipelines.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pipelines.is_empty()
    }

    pub(super) fn get(
        &self,
        plan: &Plan,
        pass: &PlannedPass,
    ) -> Result<(&Pipeline, &wgpu::BindGroupLayout), RecordError> {
        let label = label(pass);
        let key = PipelineKey::of(plan, pass, &label)?;
        self.pipelines
            .get(&key)
            .zip(self.layouts.get(&key.layout))
            .ok_or(RecordError::MissingPipeline { pass: label })
    }
}

/// The label of every object that belongs to a pass.
pub(super) fn label(pass: &PlannedPass) -> String {
    format!("moment-shadows/{}/{}", pass.node, pass.label)
}

impl PipelineKey {
    fn of(plan: &Plan, pass: &PlannedPass, label: &str) -> Result<Self, RecordError> {
        let target = match pass.work {
            PlannedWork::Fullscreen { target } => {
                let format = plan.resources[target]
                    .desc
                    .texture()
                    .map(|texture| texture.format);
                Some(
                    format
                        .and_then(texture_format)
                        .ok_or_else(|| RecordError::Device {
                            what: label.to_owned(),
                            reason: format!("{format:?} cannot be drawn to by this recorder"),
                        })?,
                )
            }
            _ => None,
        };
        Ok(Self {
            wgsl: pass.wgsl.clone(),
            entry_point: pass.entry_point.clone(),
            constants: pass
                .constants
                .iter()
                .map(|(name, value)| (name.clone(), value.to_bits()))
                .collect(),
            layout: LayoutKey::of(plan, pass),
            target,
            bind_group: plan.bind_group,
        })
    }

    fn create(
        &self,
        device: &wgpu::Device,
        label: &str,
        layout: Option<&wgpu::BindGroupLayout>,
        pass: &PlannedPass,
        options: PipelineOptions<'_>,
    ) -> Pipeline {
        let shader = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Wgsl(self.wgsl.as_str().into()),
        });
        // Groups below ours are the host's; they stay empty here.
        let mut groups = vec![None; self.bind_group as usize];
        groups.push(layout);
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(label),
            bind_group_layouts: &groups,
            immediate_size: 0,
        });
        let constants: Vec<(&str, f64)> = pass
            .constants
            .iter()
            .map(|(name, value)| (name.as_str(), *value))
            .collect();
        let compilation_options = wgpu::PipelineCompilationOptions {
            constants: &constants,
            ..Default::default()
        };
        match self.target {
            None => Pipeline::Compute(device.create_compute_pipeline(
                &wgpu::ComputePipelineDescriptor {
                    label: Some(label),
                    layout: Some(&layout),
                    module: &shader,
                    entry_point: Some(&self.entry_point),
                    compilation_options,
                    cache: options.cache,
                },
            )),
            Some(format) => Pipeline::Render(device.create_render_pipeline(
                &wgpu::RenderPipelineDescriptor {
                    label: Some(label),
                    layout: Some(&layout),
                    vertex: wgpu::VertexState {
                        module: &shader,
                        entry_point: Some("fullscreen"),
                        compilation_options: wgpu::PipelineCompilationOptions::default(),
                        buffers: &[],
                    },
                    primitive: wgpu::PrimitiveState::default(),
                    depth_stencil: None,
                    multisample: wgpu::MultisampleState::default(),
                    fragment: Some(wgpu::FragmentState {
                        module: &shader,
                        entry_point: Some(&self.entry_point),
                        compilation_options,
                        targets: &[Some(format.into())],
                    }),
                    multiview_mask: None,
                    cache: options.cache,
                },
            )),
        }
    }
}
