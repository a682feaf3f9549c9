//! Pipelines, one per distinct shader text, constants and formats.

use std::collections::{BTreeSet, HashMap};

use wgpu::BlendFactor;

use super::at_once::at_once;
use super::layout;
use super::scope::{check_alive, scoped};
use crate::error::unknown;
use crate::{GraphError, GraphErrorKind, Plan, PlannedPass, PlannedWork};

/// How pipelines are made.
#[derive(Clone, Debug, Default)]
pub struct PipelineOptions {
    /// A cache of compiled shaders that the host keeps.
    pub cache: Option<wgpu::PipelineCache>,
    /// The fullscreen passes (`node/pass`) that [`crate::record::Bindings::draw`] draws into render passes other than
    /// those of the plan, and what these look like.
    pub host_targets: Vec<(String, HostTarget)>,
}

/// A render pass that the host has open, as far as a pipeline depends on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct HostTarget {
    /// The format of its one colour target.
    pub format: wgpu::TextureFormat,
    /// How the pass is blended with what is there. `shade_hard` gives the shadow intensity in all four channels.
    pub blend: Option<wgpu::BlendState>,
    /// The format of its depth or stencil attachment, which is neither tested nor written.
    pub depth_stencil: Option<wgpu::TextureFormat>,
    /// Samples per pixel.
    pub samples: u32,
}

impl HostTarget {
    /// A colour target alone, with one sample per pixel and without blending.
    #[must_use]
    pub fn new(format: wgpu::TextureFormat) -> Self {
        Self {
            format,
            blend: None,
            depth_stencil: None,
            samples: 1,
        }
    }

    /// A target that is darkened: its colours are multiplied by 1 - shadow intensity, and its alpha stays. Otherwise like
    /// [`new`](Self::new).
    #[must_use]
    pub fn darkened(format: wgpu::TextureFormat) -> Self {
        Self::blended(format, BlendFactor::Zero, BlendFactor::OneMinusSrc)
    }

    /// A target for `composite_scattering`: its colours are multiplied by the transmittance, in-scattered radiance is added
    /// to them, and its alpha stays. Otherwise like [`new`](Self::new).
    #[must_use]
    pub fn scattered(format: wgpu::TextureFormat) -> Self {
        Self::blended(format, BlendFactor::One, BlendFactor::SrcAlpha)
    }

    /// A target whose colours become `source` x drawn + `target` x what is there; its alpha stays.
    fn blended(format: wgpu::TextureFormat, source: BlendFactor, target: BlendFactor) -> Self {
        let sum = |src_factor, dst_factor| wgpu::BlendComponent {
            src_factor,
            dst_factor,
            operation: wgpu::BlendOperation::Add,
        };
        Self {
            blend: Some(wgpu::BlendState {
                color: sum(source, target),
                alpha: sum(BlendFactor::Zero, BlendFactor::One),
            }),
            ..Self::new(format)
        }
    }
}

/// Every pipeline that one or more plans need. Made once; a change of sizes needs no new one.
#[derive(Debug, Default)]
pub struct Pipelines {
    pipelines: HashMap<PipelineKey, (Pipeline, wgpu::BindGroupLayout)>,
    /// For each pipeline that of a render pass of the host, the last one that was asked for.
    drawn: HashMap<PipelineKey, PipelineKey>,
}

/// What a pipeline depends on.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct PipelineKey {
    wgsl: String,
    entry_point: String,
    vertex_entry_point: Option<String>,
    /// Bit patterns, so that the key can be compared and hashed.
    constants: Vec<(String, u64)>,
    layout: Vec<wgpu::BindGroupLayoutEntry>,
    target: Option<HostTarget>,
    bind_group: u32,
}

#[derive(Clone, Debug)]
pub(super) enum Pipeline {
    Compute(wgpu::ComputePipeline),
    Render(wgpu::RenderPipeline),
}

/// What a pass is recorded with.
#[derive(Clone, Copy)]
pub(super) struct Made<'a> {
    pub(super) pipeline: &'a Pipeline,
    pub(super) layout: &'a wgpu::BindGroupLayout,
    /// What draws a fullscreen pass into a render pass of the host: the same, unless another was asked for.
    pub(super) drawn: &'a Pipeline,
}

impl Pipelines {
    /// The pipelines of a plan. May be called long before the first frame. They are made on as many threads as there are processors, this one
    /// included, but for browsers.
    pub async fn create(
        device: &wgpu::Device,
        plan: &Plan,
        options: PipelineOptions,
    ) -> Result<Self, GraphError> {
        let mut pipelines = Self::default();
        pipelines.extend(device, plan, options).await?;
        Ok(pipelines)
    }

    /// Adds the pipelines that a further plan needs, and says how many were made: none where only sizes differ.
    pub async fn extend(
        &mut self,
        device: &wgpu::Device,
        plan: &Plan,
        options: PipelineOptions,
    ) -> Result<usize, GraphError> {
        let is_drawn = |pass: &&PlannedPass| matches!(pass.work, PlannedWork::Fullscreen { .. });
        let drawn = plan.passes.iter().filter(is_drawn);
        let drawn: Vec<String> = drawn.map(PlannedPass::name).collect();
        for (pass, _) in &options.host_targets {
            if !drawn.contains(pass) {
                return Err(no_such_pass(pass, drawn.iter().map(String::as_str)));
            }
        }
        self.extend_by_part(device, plan, &options).await
    }

    /// As [`extend`](Self::extend), for a plan that need not have all the passes that the options name.
    pub(crate) async fn extend_by_part(
        &mut self,
        device: &wgpu::Device,
        plan: &Plan,
        options: &PipelineOptions,
    ) -> Result<usize, GraphError> {
        plan.check()?;
        check_alive(device).await?;
        let mut wanted: Vec<(PipelineKey, String)> = Vec::new();
        for pass in &plan.passes {
            if matches!(pass.work, PlannedWork::Host { .. }) {
                continue;
            }
            let key = PipelineKey::of(plan, pass);
            let mut keys = vec![key];
            let mut hosts = options.host_targets.iter();
            if let Some((_, target)) = hosts.find(|(of, _)| *of == pass.name()) {
                let drawn = PipelineKey {
                    target: Some(*target),
                    ..keys[0].clone()
                };
                self.drawn.insert(keys[0].clone(), drawn.clone());
                keys.push(drawn);
            }
            for key in keys {
                let is_known = self.pipelines.contains_key(&key);
                if !is_known && wanted.iter().all(|(other, _)| *other != key) {
                    wanted.push((key, label(pass)));
                }
            }
        }
        let cache = options.cache.as_ref();
        let modules = modules(device, &wanted).await?;
        let made = at_once(&wanted, |(key, label)| {
            let module = &modules[key.wgsl.as_str()];
            scoped(device, label, || key.create(device, label, cache, module))
        });
        let mut pipelines = Vec::with_capacity(wanted.len());
        for verdict in made {
            pipelines.push(verdict.await?);
        }
        drop(modules);
        check_alive(device).await?;
        let made = pipelines.len();
        let keys = wanted.into_iter().map(|(key, _)| key);
        self.pipelines.extend(keys.zip(pipelines));
        Ok(made)
    }

    /// How many pipelines there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.pipelines.len()
    }

    /// Whether there is no pipeline.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pipelines.is_empty()
    }

    pub(super) fn get(&self, plan: &Plan, pass: &PlannedPass) -> Result<Made<'_>, GraphError> {
        let key = PipelineKey::of(plan, pass);
        let (pipeline, layout) = self.pipelines.get(&key).ok_or_else(|| missing(pass))?;
        let drawn = self.drawn.get(&key);
        let drawn = drawn.and_then(|drawn| self.pipelines.get(drawn));
        Ok(Made {
            pipeline,
            layout,
            drawn: drawn.map_or(pipeline, |(drawn, _)| drawn),
        })
    }
}

/// The module of each text: directions of a blur, mip levels and the like are constants of one.
async fn modules<'a>(
    device: &wgpu::Device,
    wanted: &'a [(PipelineKey, String)],
) -> Result<HashMap<&'a str, wgpu::ShaderModule>, GraphError> {
    let mut seen = BTreeSet::new();
    let texts = wanted
        .iter()
        .map(|(key, label)| (key.wgsl.as_str(), label.as_str()));
    let texts: Vec<_> = texts.filter(|(text, _)| seen.insert(*text)).collect();
    let made = at_once(&texts, |&(text, label)| {
        let source = wgpu::ShaderSource::Wgsl(text.into());
        let desc = wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source,
        };
        scoped(device, label, || device.create_shader_module(desc))
    });
    let mut modules = HashMap::new();
    for (verdict, (text, _)) in made.into_iter().zip(&texts) {
        modules.insert(*text, verdict.await?);
    }
    Ok(modules)
}

/// The error about a pass of another plan.
pub(super) fn missing(pass: &PlannedPass) -> GraphError {
    GraphError::new(
        GraphErrorKind::Plan,
        format!(
            "pass '{}' has no pipeline; extend the pipelines with this plan first",
            pass.name()
        ),
    )
}

/// The error about a name that no fullscreen pass has.
pub(super) fn no_such_pass<'a>(pass: &str, known: impl Iterator<Item = &'a str>) -> GraphError {
    unknown("fullscreen pass", pass, known, "written 'node/pass'")
}

/// The label of every object that belongs to a pass.
pub(super) fn label(pass: &PlannedPass) -> String {
    format!("moment-shadows/{}", pass.name())
}

impl PipelineKey {
    fn of(plan: &Plan, pass: &PlannedPass) -> Self {
        let target = match pass.work {
            PlannedWork::Fullscreen { target, .. } => plan.resources[target].desc.texture(),
            PlannedWork::Compute { .. } | PlannedWork::Host { .. } => None,
        };
        let constants = pass.constants.iter();
        Self {
            wgsl: plan.wgsl(pass).to_owned(),
            entry_point: pass.entry_point.clone(),
            vertex_entry_point: pass.vertex_entry_point.clone(),
            constants: constants
                .map(|(name, value)| (name.clone(), value.to_bits()))
                .collect(),
            layout: layout::entries(pass),
            target: target.map(|texture| HostTarget::new(texture.wgpu_format())),
            bind_group: plan.bind_group,
        }
    }

    fn create(
        &self,
        device: &wgpu::Device,
        label: &str,
        cache: Option<&wgpu::PipelineCache>,
        module: &wgpu::ShaderModule,
    ) -> (Pipeline, wgpu::BindGroupLayout) {
        let group = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some(label),
            entries: &self.layout,
        });
        // Groups below ours are the host's; they stay empty here. More than a device has, it refuses: no need of all that a plan claims.
        let below = self.bind_group.min(device.limits().max_bind_groups);
        let mut groups = vec![None; below as usize];
        groups.push(Some(&group));
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(label),
            bind_group_layouts: &groups,
            immediate_size: 0,
        });
        let constants = self.constants.iter();
        let constants: Vec<(&str, f64)> = constants
            .map(|(name, bits)| (name.as_str(), f64::from_bits(*bits)))
            .collect();
        let compilation_options = wgpu::PipelineCompilationOptions {
            constants: &constants,
            ..Default::default()
        };
        let pipeline = match self.target {
            None => Pipeline::Compute(device.create_compute_pipeline(
                &wgpu::ComputePipelineDescriptor {
                    label: Some(label),
                    layout: Some(&layout),
                    module,
                    entry_point: Some(&self.entry_point),
                    compilation_options,
                    cache,
                },
            )),
            Some(target) => Pipeline::Render(device.create_render_pipeline(
                &wgpu::RenderPipelineDescriptor {
                    label: Some(label),
                    layout: Some(&layout),
                    vertex: wgpu::VertexState {
                        module,
                        entry_point: self.vertex_entry_point.as_deref(),
                        compilation_options: wgpu::PipelineCompilationOptions::default(),
                        buffers: &[],
                    },
                    primitive: wgpu::PrimitiveState::default(),
                    depth_stencil: target.depth_stencil.map(|format| wgpu::DepthStencilState {
                        format,
                        depth_write_enabled: Some(false),
                        depth_compare: Some(wgpu::CompareFunction::Always),
                        stencil: wgpu::StencilState::default(),
                        bias: wgpu::DepthBiasState::default(),
                    }),
                    multisample: wgpu::MultisampleState {
                        count: target.samples,
                        ..Default::default()
                    },
                    fragment: Some(wgpu::FragmentState {
                        module,
                        entry_point: Some(&self.entry_point),
                        compilation_options,
                        targets: &[Some(wgpu::ColorTargetState {
                            blend: target.blend,
                            ..target.format.into()
                        })],
                    }),
                    multiview_mask: None,
                    cache,
                },
            )),
        };
        (pipeline, group)
    }
}
