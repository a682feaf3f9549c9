//! Any plan in nightshade's render graph, which orders passes, leaves out unread ones, makes textures and shares their memory.

use std::collections::HashMap;
use std::sync::{Arc, Mutex};

use moment_shadows_graph::{
    Home, Lives, Plan, PlannedPass, PlannedResource, PlannedUse, TextureDesc,
};
use nightshade_renderer::rendergraph::{
    self, PassExecutionContext, PassNode, RenderGraph, RenderGraphTextureDescriptor, ResourceId,
    ResourceType, SubGraphRunCommand, render_graph_add_pass, render_graph_get_pass_mut,
    render_graph_resources_mut,
};

use crate::device::{self, Object, Pipelines, Recorder, by_name};
use crate::error::HostError;
use crate::variants::stand_in;

/// What changes from frame to frame.
#[derive(Default)]
pub struct Inputs {
    /// Where the view's block begins in the parameters.
    pub view: u32,
    /// The layers that changed, by map; all layers of a map that is not listed.
    pub changed: HashMap<String, Vec<u32>>,
    /// The passes, in the order in which they were recorded.
    pub recorded: Mutex<Vec<String>>,
}

/// Makes the node of a pass that the host draws itself, with these slots for each resource.
pub type Draw = fn(&PlannedPass, &[Vec<String>]) -> Option<Box<dyn PassNode<Inputs>>>;

/// What the host gives.
pub struct Host<'a> {
    pub device: &'a wgpu::Device,
    pub queue: &'a wgpu::Queue,
    pub pipelines: &'a Pipelines,
    pub parameters: &'a wgpu::Buffer,
    /// Whether frames list [`Inputs::changed`]: then maps are kept.
    pub leaves_out_layers: bool,
    /// By name: a texture or buffer, or a texture for each layer where it has several samples.
    pub imports: &'a HashMap<&'a str, Vec<ResourceId>>,
    pub draw: Draw,
}

/// Adds the resources and passes of a plan, after the passes that write its imports. Gives the resources, in the plan's order.
pub fn add_plan(
    graph: &mut RenderGraph<Inputs>,
    plan: &Plan,
    host: &Host<'_>,
) -> Result<Vec<Vec<ResourceId>>, HostError> {
    let slots: Arc<Vec<Vec<String>>> = Arc::new(plan.resources.iter().map(slots_of).collect());
    let (mut ids, mut mapping) = (Vec::new(), Vec::new());
    for (index, (resource, slots)) in plan.resources.iter().zip(slots.iter()).enumerate() {
        let of = match resource.home {
            Home::Memory(_) => vec![add_resource(graph, plan, index, host)?],
            Home::Import(_) => {
                let given = host.imports.get(resource.name.as_str());
                let given = given.filter(|given| given.len() == slots.len()).cloned();
                given.ok_or_else(|| HostError::Import(resource.name.clone(), slots.len()))?
            }
        };
        mapping.extend(slots.iter().map(String::as_str).zip(of.iter().copied()));
        ids.push(of);
    }
    for pass in &plan.passes {
        let name = pass.name();
        if render_graph_get_pass_mut(graph, &name).is_some() {
            return Err(HostError::Taken(name));
        }
        let slots = slots.clone();
        let node = match host.pipelines.recorder(plan, pass, host.parameters) {
            Some(recorder) => Box::new(Node { slots, recorder }),
            None => (host.draw)(pass, &slots).ok_or(HostError::Pass(name))?,
        };
        render_graph_add_pass(graph, node, &mapping)?;
    }
    Ok(ids)
}

/// All passes have the same slots: the textures and buffers of the plan. Those with several samples have no layers.
fn slots_of(it: &PlannedResource) -> Vec<String> {
    let several = it.desc.texture().filter(|it| it.samples > 1);
    let layers = 0..several.map_or(1, TextureDesc::array_layers);
    layers.map(|layer| format!("{} {layer}", it.name)).collect()
}

/// Adds a resource of the plan's own: a transient one, where it need not last.
fn add_resource(
    graph: &mut RenderGraph<Inputs>,
    plan: &Plan,
    index: usize,
    host: &Host<'_>,
) -> Result<ResourceId, HostError> {
    let (of, resources) = (&plan.resources[index], render_graph_resources_mut(graph));
    let (name, stand_in) = (of.name.clone(), stand_in(plan, index)?);
    let Some(texture) = of.desc.texture() else {
        let id = resources.register_external_resource(name, ResourceType::ExternalBuffer);
        resources.set_external_buffer(id, device::buffer(host.device, of)?);
        return Ok(id);
    };
    let descriptor = RenderGraphTextureDescriptor {
        format: by_name(texture.format)?,
        width: texture.size[0],
        height: texture.size[1],
        usage: device::texture_usage(plan, index)?,
        sample_count: texture.samples,
        mip_level_count: texture.mips,
        dimension: wgpu::TextureDimension::D2,
        depth_or_array_layers: texture.array_layers(),
    };
    let is_kept = of.lives == Lives::LayersLeftOut && host.leaves_out_layers;
    let lasts = is_kept || of.lives == Lives::Always || stand_in.is_some();
    if !lasts && !has_odd_layers(plan, texture) {
        let transient = ResourceType::TransientColor {
            descriptor,
            clear_color: None,
            force_store: false,
        };
        return Ok(resources.register_transient_resource_fixed(name, transient));
    }
    let device = host.device;
    let made = device.create_texture(&descriptor.to_wgpu_descriptor(Some(&of.name)));
    if let Some(texels) = stand_in {
        device::fill(device, host.queue, &made, texels);
    }
    let view = made.create_view(&Default::default());
    let external = ResourceType::ExternalColor { clear_color: None };
    let id = resources.register_external_resource(name, external);
    resources.set_external_texture(id, Some(made), view, texture.size[0], texture.size[1]);
    Ok(id)
}

/// The render graph compares no layers where it lets textures share memory.
fn has_odd_layers(plan: &Plan, texture: &TextureDesc) -> bool {
    let like = |it: &TextureDesc| (it.format, it.size, it.mips, it.samples);
    let mut all = plan.resources.iter().filter_map(|it| it.desc.texture());
    all.any(|it| like(it) == like(texture) && it.array_layers() != texture.array_layers())
}

/// A pass of a plan.
struct Node {
    slots: Arc<Vec<Vec<String>>>,
    recorder: Recorder,
}

impl Node {
    fn slots(&self, uses: &[PlannedUse]) -> Vec<&str> {
        let slots = uses.iter().flat_map(|it| &self.slots[it.resource]);
        slots.map(String::as_str).collect()
    }
}

impl PassNode<Inputs> for Node {
    fn name(&self) -> &str {
        &self.recorder.name
    }

    fn reads(&self) -> Vec<&str> {
        self.slots(&self.recorder.pass.reads)
    }

    fn writes(&self) -> Vec<&str> {
        self.slots(&self.recorder.pass.writes)
    }

    fn invalidate_bind_groups(&mut self) {
        self.recorder.forget();
    }

    fn execute<'r, 'e>(
        &mut self,
        context: PassExecutionContext<'r, 'e, Inputs>,
    ) -> rendergraph::Result<Vec<SubGraphRunCommand<'r>>> {
        let (inputs, pass) = (context.configs, &self.recorder.pass);
        let changed = inputs.changed.get(&pass.map).filter(|_| pass.each_layer);
        let layers = changed.cloned().unwrap_or((0..pass.layers).collect());
        // A node that is switched off is executed as well.
        if layers.is_empty() || !context.is_pass_enabled() {
            return Ok(Vec::new());
        }
        let mut objects = HashMap::new();
        for of in pass.reads.iter().chain(&pass.writes) {
            let slots = &self.slots[of.resource];
            let textures = slots.iter().map(|slot| context.get_texture(slot));
            let textures = textures.collect::<Result<_, _>>().map(Object::Textures);
            let buffer = |_| context.get_buffer(&slots[0]).map(Object::Buffer);
            objects.insert(of.resource, textures.or_else(buffer)?);
        }
        for layer in layers {
            let (device, at) = (context.device, (inputs.view, layer));
            self.recorder.record(device, context.encoder, &objects, at);
        }
        let recorded = inputs.recorded.lock();
        recorded
            .map(|mut it| it.push(self.recorder.name.clone()))
            .ok();
        Ok(Vec::new())
    }
}
