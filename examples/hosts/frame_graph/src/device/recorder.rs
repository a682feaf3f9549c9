//! Recording a pass for a layer.

use std::collections::HashMap;

use moment_shadows_graph::{
    BindingLayout, Plan, PlannedBinding, PlannedBindingResource, PlannedPart, PlannedPass,
    PlannedWork,
};
use wgpu::{BindingResource, TextureAspect, TextureViewDimension};

use super::pipelines::{OfPass, Pipeline};

/// What a resource of the plan is: a texture for each layer where it has several samples, else one.
pub enum Object<'a> {
    Textures(Vec<&'a wgpu::Texture>),
    Buffer(&'a wgpu::Buffer),
}

/// What the resources of a pass are, by their indices in the plan.
pub type Objects<'a> = HashMap<usize, Object<'a>>;

/// Records a pass.
pub struct Recorder {
    /// `node/pass`.
    pub name: String,
    pub pass: PlannedPass,
    of_pass: OfPass,
    parameters: wgpu::Buffer,
    bind_group: u32,
    /// How many planes the textures of the plan have for each layer.
    planes: Vec<u32>,
    /// By layer.
    groups: HashMap<u32, wgpu::BindGroup>,
}

impl Recorder {
    pub(super) fn new(
        plan: &Plan,
        pass: &PlannedPass,
        of_pass: &OfPass,
        parameters: &wgpu::Buffer,
    ) -> Self {
        let textures = plan
            .resources
            .iter()
            .map(|resource| resource.desc.texture());
        let planes = textures.map(|texture| texture.map_or(1, |texture| texture.planes));
        Self {
            name: pass.name(),
            pass: pass.clone(),
            of_pass: of_pass.clone(),
            parameters: parameters.clone(),
            bind_group: plan.bind_group,
            planes: planes.collect(),
            groups: HashMap::new(),
        }
    }

    /// To be called when a resource is another object than before.
    pub fn forget(&mut self) {
        self.groups.clear();
    }

    /// Records the pass for a view, by the start of its block, and a layer.
    pub fn record(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        objects: &Objects<'_>,
        (view, layer): (u32, u32),
    ) {
        if !self.groups.contains_key(&layer) {
            let group = self.group(device, objects, layer);
            self.groups.insert(layer, group);
        }
        let (slot, group) = (self.bind_group, &self.groups[&layer]);
        let offsets = self.pass.dynamic_offsets.iter();
        let offsets: Vec<u32> = offsets
            .map(|it| view + it.offset + layer * it.stride)
            .collect();
        match (&self.pass.work, &self.of_pass.pipeline) {
            (
                &PlannedWork::Compute {
                    workgroups: [x, y], ..
                },
                Pipeline::Compute(pipeline),
            ) => {
                let mut work = encoder.begin_compute_pass(&Default::default());
                work.set_pipeline(pipeline);
                work.set_bind_group(slot, group, &offsets);
                work.dispatch_workgroups(x, y, 1);
            }
            (
                &PlannedWork::Fullscreen {
                    target,
                    part,
                    keeps,
                },
                Pipeline::Render(pipeline),
            ) => {
                let load = if keeps {
                    wgpu::LoadOp::Load
                } else {
                    wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT)
                };
                if let Some(view) = self.view(objects, target, Some(part), layer) {
                    let mut work = draw(encoder, &view, load);
                    work.set_pipeline(pipeline);
                    work.set_bind_group(slot, group, &offsets);
                    work.draw(0..3, 0..1);
                }
            }
            // A host's pass has no pipeline.
            _ => {}
        }
    }

    fn group(&self, device: &wgpu::Device, objects: &Objects<'_>, layer: u32) -> wgpu::BindGroup {
        let bindings = &self.pass.bindings;
        let views = bindings.iter().map(|binding| match binding.resource {
            PlannedBindingResource::Texture { resource, part } => {
                self.view(objects, resource, part, layer)
            }
            PlannedBindingResource::StorageTexture { resource, part } => {
                self.view(objects, resource, Some(part), layer)
            }
            _ => None,
        });
        let views: Vec<_> = views.collect();
        let entries = bindings.iter().zip(&views);
        let entries = entries.map(|(binding, view)| wgpu::BindGroupEntry {
            binding: binding.binding,
            resource: match view {
                Some(view) => BindingResource::TextureView(view),
                None => self.bound(binding, objects),
            },
        });
        let entries: Vec<_> = entries.collect();
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(&self.pass.label),
            layout: &self.of_pass.layout,
            entries: &entries,
        })
    }

    /// What is bound, where it is no texture: a sampler, a buffer, or as many bytes of the parameters as the layout says.
    fn bound<'a>(
        &'a self,
        binding: &PlannedBinding,
        objects: &'a Objects<'_>,
    ) -> BindingResource<'a> {
        if let Some(sampler) = self.of_pass.samplers.get(&binding.binding) {
            return BindingResource::Sampler(sampler);
        }
        if let PlannedBindingResource::Buffer { resource } = binding.resource
            && let Some(Object::Buffer(buffer)) = objects.get(&resource)
        {
            return buffer.as_entire_binding();
        }
        let size = match binding.layout {
            BindingLayout::Buffer {
                min_binding_size, ..
            } => min_binding_size,
            _ => 0,
        };
        BindingResource::Buffer(wgpu::BufferBinding {
            buffer: &self.parameters,
            offset: 0,
            size: wgpu::BufferSize::new(size.into()),
        })
    }

    /// One level of one plane of the layer; without a part all of a texture.
    fn view(
        &self,
        objects: &Objects<'_>,
        resource: usize,
        part: Option<PlannedPart>,
        layer: u32,
    ) -> Option<wgpu::TextureView> {
        let Object::Textures(textures) = objects.get(&resource)? else {
            return None;
        };
        let at = part.map_or(0, |part| layer * self.planes[resource] + part.plane);
        // One texture has all layers, or each has one.
        let texture = textures[at as usize % textures.len()];
        let [all, one] = [TextureViewDimension::D2Array, TextureViewDimension::D2];
        Some(texture.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(part.map_or(all, |_| one)),
            aspect: match texture.format().has_depth_aspect() {
                true => TextureAspect::DepthOnly,
                false => TextureAspect::All,
            },
            base_array_layer: at % texture.depth_or_array_layers(),
            array_layer_count: part.map(|_| 1),
            base_mip_level: part.map_or(0, |part| part.level),
            mip_level_count: part.map(|_| 1),
            ..Default::default()
        }))
    }
}

/// A render pass on a view, whose contents are kept.
pub(super) fn draw<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    view: &wgpu::TextureView,
    load: wgpu::LoadOp<wgpu::Color>,
) -> wgpu::RenderPass<'a> {
    let store = wgpu::StoreOp::Store;
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load, store },
        })],
        ..Default::default()
    })
}
