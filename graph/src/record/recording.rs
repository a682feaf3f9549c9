//! Recording: the only part that runs every frame. It creates no object and allocates nothing.

use super::Bindings;
use super::bindings::{Action, MOST_UNIFORMS, Step};
use super::pipelines::no_such_pass;
use crate::error::{ensure, unknown};
use crate::{GraphError, GraphErrorKind, Stage};

/// Which layers of the maps are to be made anew. Other layers keep their contents.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layers<'a> {
    /// All layers.
    #[default]
    All,
    /// These layers of every map.
    Only(&'a [u32]),
    /// These of the maps with these names: an import's, or `node.slot` where a node makes a map of its own. Other
    /// maps are left out.
    OfMaps(&'a [(&'a str, &'a [u32])]),
}

/// A pass that the host draws itself.
#[derive(Clone, Copy, Debug)]
pub struct HostPass<'a> {
    /// `node/pass`.
    pub name: &'a str,
    /// The layer that it is drawn for; 0 where it is drawn once.
    pub layer: u32,
    /// The colour targets: of a map with planes all those of the layer.
    pub targets: &'a [wgpu::TextureView],
    /// The depth target.
    pub depth: Option<&'a wgpu::TextureView>,
    /// Whether the node asks for blending.
    pub blend: bool,
}

/// Draws a host's pass.
pub(crate) type HostPassHandler<'a> = &'a mut dyn FnMut(HostPass<'_>, &mut wgpu::CommandEncoder);

/// What to record.
#[derive(Default)]
pub struct Recording<'a> {
    /// Byte offset of the view's block in the parameter buffer.
    pub parameter_offset: u64,
    /// The layers to make anew.
    pub layers: Layers<'a>,
    /// The numbers in [`Plan::passes`](crate::Plan::passes) of the passes to record, in the plan's order: to spread a stage
    /// over frames, or to measure its passes one by one. Passes of other stages are left out. All, where `None`.
    pub passes: Option<&'a [usize]>,
    /// A set of timestamp queries, and the first that is written: pass number i of the plan writes the queries
    /// `first + 2 i` at its beginning and `first + 2 i + 1` at its end. A pass without dirty layers writes none, and neither
    /// does a host's pass.
    pub timestamps: Option<(&'a wgpu::QuerySet, u32)>,
    /// What draws the host's passes, where the plan has any.
    pub host_passes: Option<HostPassHandler<'a>>,
}

impl Bindings {
    /// Records one stage. Everything is checked first: an error leaves the encoder as it was.
    pub fn record(
        &self,
        stage: Stage,
        encoder: &mut wgpu::CommandEncoder,
        mut recording: Recording<'_>,
    ) -> Result<(), GraphError> {
        self.check_offset(recording.parameter_offset)?;
        self.check(&recording)?;
        let asked = |index: &usize| recording.passes.is_none_or(|listed| listed.contains(index));
        let in_stage = || {
            let steps = self.steps.iter().enumerate();
            steps.filter(|(index, step)| step.stage == stage && asked(index))
        };
        for (_, step) in in_stage() {
            step.check(stage, &recording)?;
        }
        for (index, step) in in_stage() {
            let queries = recording.timestamps;
            let queries = queries.map(|(queries, first)| (queries, first + 2 * index as u32));
            match &step.action {
                Action::Dispatch {
                    pipeline,
                    workgroups,
                } => self.dispatch(step, pipeline, *workgroups, encoder, &recording, queries),
                Action::Draw {
                    pipeline,
                    targets,
                    load,
                    ..
                } => {
                    let targets = (&targets[..], *load);
                    self.draw_layers(step, pipeline, targets, encoder, &recording, queries);
                }
                Action::Host { targets, blend } => {
                    let Some(handler) = &mut recording.host_passes else {
                        continue;
                    };
                    for layer in step.dirty(recording.layers) {
                        let Some((targets, depth)) = targets.get(layer as usize) else {
                            continue;
                        };
                        let pass = HostPass {
                            name: &step.name,
                            layer,
                            targets,
                            depth: depth.as_ref(),
                            blend: *blend,
                        };
                        handler(pass, encoder);
                    }
                }
            }
        }
        Ok(())
    }

    /// Draws a fullscreen pass (`node/pass`) into a render pass that the host has open. The render pass looks as
    /// [`PipelineOptions::host_targets`](super::PipelineOptions::host_targets) says for this pass; where nothing was said,
    /// it has one target of the plan's format, one sample and no depth. The picture fills the host's viewport.
    ///
    /// Do not record the pass as well: leave its stage out, or the pass by [`Recording::passes`].
    pub fn draw(
        &self,
        pass: &str,
        render_pass: &mut wgpu::RenderPass<'_>,
        parameter_offset: u64,
    ) -> Result<(), GraphError> {
        self.check_offset(parameter_offset)?;
        let draws = || {
            self.steps.iter().filter_map(|step| match &step.action {
                Action::Draw { drawn, .. } => Some((step, drawn)),
                Action::Dispatch { .. } | Action::Host { .. } => None,
            })
        };
        let (step, pipeline) = draws()
            .find(|(step, _)| step.name == pass)
            .ok_or_else(|| no_such_pass(pass, draws().map(|(step, _)| step.name.as_str())))?;
        self.draw_layer(step, pipeline, render_pass, parameter_offset, 0);
        Ok(())
    }

    fn draw_layer(
        &self,
        step: &Step,
        pipeline: &wgpu::RenderPipeline,
        pass: &mut wgpu::RenderPass<'_>,
        parameter_offset: u64,
        layer: u32,
    ) {
        pass.set_pipeline(pipeline);
        let (offsets, count) = step.dynamic_offsets(parameter_offset, layer);
        let group = step.bind_groups.get(layer as usize);
        pass.set_bind_group(self.bind_group, group, &offsets[..count]);
        pass.draw(0..3, 0..1);
    }

    fn dispatch(
        &self,
        step: &Step,
        pipeline: &wgpu::ComputePipeline,
        workgroups: [u32; 2],
        encoder: &mut wgpu::CommandEncoder,
        recording: &Recording<'_>,
        queries: Option<(&wgpu::QuerySet, u32)>,
    ) {
        if step.dirty(recording.layers).next().is_none() {
            return;
        }
        let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
            label: Some(&step.label),
            timestamp_writes: queries.map(|(query_set, begin)| wgpu::ComputePassTimestampWrites {
                query_set,
                beginning_of_pass_write_index: Some(begin),
                end_of_pass_write_index: Some(begin + 1),
            }),
        });
        pass.set_pipeline(pipeline);
        for layer in step.dirty(recording.layers) {
            let (offsets, count) = step.dynamic_offsets(recording.parameter_offset, layer);
            let group = step.bind_groups.get(layer as usize);
            pass.set_bind_group(self.bind_group, group, &offsets[..count]);
            pass.dispatch_workgroups(workgroups[0], workgroups[1], 1);
        }
    }

    fn draw_layers(
        &self,
        step: &Step,
        pipeline: &wgpu::RenderPipeline,
        (targets, load): (&[wgpu::TextureView], wgpu::LoadOp<wgpu::Color>),
        encoder: &mut wgpu::CommandEncoder,
        recording: &Recording<'_>,
        queries: Option<(&wgpu::QuerySet, u32)>,
    ) {
        let count = step.dirty(recording.layers).count();
        for (order, layer) in step.dirty(recording.layers).enumerate() {
            let Some(view) = targets.get(layer as usize) else {
                continue;
            };
            // A pass between the first and the last layer's writes nothing; it must not say so.
            let timestamp_writes =
                queries
                    .filter(|_| order == 0 || order + 1 == count)
                    .map(|(query_set, begin)| wgpu::RenderPassTimestampWrites {
                        query_set,
                        beginning_of_pass_write_index: (order == 0).then_some(begin),
                        end_of_pass_write_index: (order + 1 == count).then_some(begin + 1),
                    });
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some(&step.label),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load,
                        store: wgpu::StoreOp::Store,
                    },
                })],
                depth_stencil_attachment: None,
                timestamp_writes,
                occlusion_query_set: None,
                multiview_mask: None,
            });
            self.draw_layer(step, pipeline, &mut pass, recording.parameter_offset, layer);
        }
    }

    fn check_offset(&self, offset: u64) -> Result<(), GraphError> {
        let Some(buffer) = &self.parameters else {
            return Ok(());
        };
        let (alignment, needed) = (self.uniform_alignment, self.parameter_size);
        let size = buffer.size();
        let end = offset.checked_add(needed);
        let fits = end.is_some_and(|end| end <= size.min(u64::from(u32::MAX)))
            && offset.is_multiple_of(u64::from(alignment));
        ensure(fits, GraphErrorKind::Parameters, || {
            format!(
                "a view's parameters cannot begin at byte {offset}: offsets are multiples of {alignment}, and {needed} \
                 bytes have to follow in a buffer of {size}"
            )
        })
    }

    /// Whether the plan has what the recording asks for.
    fn check(&self, recording: &Recording<'_>) -> Result<(), GraphError> {
        let count = self.steps.len();
        for pass in recording.passes.unwrap_or_default() {
            ensure(*pass < count, GraphErrorKind::Recording, || {
                format!(
                    "pass number {pass} was asked for, but the plan has {count}, counted from 0"
                )
            })?;
        }
        if let Some((queries, first)) = recording.timestamps {
            let (needed, count) = (2 * count as u32, queries.count());
            let end = first.checked_add(needed);
            let fits = end.is_some_and(|end| end <= count);
            ensure(fits, GraphErrorKind::Recording, || {
                format!(
                    "timestamps need {needed} queries from index {first}, but the query set has {count}"
                )
            })?;
        }
        if let Layers::OfMaps(maps) = recording.layers {
            let mut followed = self.steps.iter().map(|step| step.map.as_str());
            for (map, _) in maps {
                if followed.clone().all(|known| known != *map) {
                    let remark = "dirty layers are those of maps that passes follow";
                    return Err(unknown("map", map, followed.by_ref(), remark));
                }
            }
        }
        Ok(())
    }
}

impl Step {
    /// The layers to record.
    fn dirty<'a>(&self, layers: Layers<'a>) -> impl Iterator<Item = u32> + use<'a> {
        let (range, listed) = match layers {
            Layers::Only(listed) if self.each_layer => (0..0, listed),
            Layers::OfMaps(maps) if self.each_layer => {
                let of_map = maps.iter().find(|(map, _)| *map == self.map);
                (0..0, of_map.map_or(&[][..], |(_, listed)| listed))
            }
            Layers::All | Layers::Only(_) | Layers::OfMaps(_) => (0..self.layers, &[][..]),
        };
        range.chain(listed.iter().copied())
    }

    /// The dynamic offsets of the uniform data, and how many there are.
    fn dynamic_offsets(&self, view: u64, layer: u32) -> ([u32; MOST_UNIFORMS], usize) {
        let mut offsets = [0; MOST_UNIFORMS];
        for (place, uniform) in offsets.iter_mut().zip(&self.uniforms) {
            // The check before recording keeps the sum within u32.
            *place = view as u32 + uniform.offset + layer * uniform.stride;
        }
        (offsets, self.uniforms.len())
    }

    fn check(&self, stage: Stage, recording: &Recording<'_>) -> Result<(), GraphError> {
        let (name, layers) = (&self.name, self.layers);
        let drawn = !matches!(self.action, Action::Host { .. }) || recording.host_passes.is_some();
        ensure(drawn, GraphErrorKind::Recording, || {
            format!("stage {stage:?} has the host's pass '{name}'; give a handler that draws it")
        })?;
        for layer in self.dirty(recording.layers) {
            ensure(layer < layers, GraphErrorKind::Recording, || {
                format!("layer {layer} is marked dirty, but pass '{name}' has {layers} layers")
            })?;
        }
        Ok(())
    }
}
