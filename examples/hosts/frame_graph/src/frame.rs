//! The host: a frame graph with passes of its own before and after those of a plan.

mod depth;
mod take;

use std::collections::{HashMap, HashSet};

use moment_shadows_graph::{Home, Plan, ResourceDesc};
use nightshade_renderer::rendergraph::{
    RenderGraph, RenderGraphTextureDescriptor, ResourceHandle, ResourceId, ResourceType,
    render_graph_add_pass, render_graph_compile, render_graph_execute, render_graph_new,
    render_graph_resources_mut,
};

use crate::adapter::{Draw, Host, Inputs, add_plan};
use crate::device::{Pipelines, by_name};
use crate::error::HostError;
use crate::gpu::Gpu;
use crate::graphs::Sizes;
use crate::world::World;
use depth::DrawDepth;
use take::Take;

/// A plan in the host's frame graph, for one set of sizes.
pub struct Frame {
    pub graph: RenderGraph<Inputs>,
    plan: Plan,
    sizes: Sizes,
    ids: Vec<Vec<ResourceId>>,
    parameters: wgpu::Buffer,
    /// What depth maps are drawn from: import, layer, samples.
    depths: Vec<(String, u32, u32, wgpu::Buffer)>,
    taken: Vec<(String, Take)>,
}

/// How a frame is drawn.
pub struct Options {
    /// Whether frames leave out layers that did not change: then maps are kept.
    pub leaves_out_layers: bool,
    /// What draws the host's own passes of a plan.
    pub draw: Draw,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            leaves_out_layers: true,
            draw: |_, _| None,
        }
    }
}

/// What a frame gave.
pub struct Drawn {
    /// Outputs by name: texels, row by row.
    pub pictures: Vec<(String, Vec<u8>)>,
    /// The passes, in the order in which they were recorded.
    pub order: Vec<String>,
}

impl Frame {
    pub fn new(
        gpu: &Gpu,
        plan: &Plan,
        pipelines: &Pipelines,
        sizes: Sizes,
        options: &Options,
    ) -> Result<Self, HostError> {
        plan.check()?;
        let mut graph = render_graph_new();
        let (mut imports, mut depths) = (HashMap::new(), Vec::new());
        for import in &plan.imports {
            let of = &plan.resources[import.value];
            let ResourceDesc::Texture(texture) = &of.desc else {
                return Err(HostError::Import(import.name.clone(), 1));
            };
            let ids: &mut Vec<ResourceId> = imports.entry(import.name.as_str()).or_default();
            for layer in 0..texture.array_layers() {
                let name = format!("draw {} {layer}", import.name);
                let draw = DrawDepth::new(gpu, name.clone(), texture)?;
                let buffer = draw.depths.clone();
                depths.push((import.name.clone(), layer, texture.samples, buffer));
                let transient = ResourceType::TransientDepth {
                    descriptor: RenderGraphTextureDescriptor {
                        format: by_name(texture.format)?,
                        width: texture.size[0],
                        height: texture.size[1],
                        usage: wgpu::TextureUsages::RENDER_ATTACHMENT
                            | wgpu::TextureUsages::TEXTURE_BINDING,
                        sample_count: texture.samples,
                        mip_level_count: 1,
                        dimension: wgpu::TextureDimension::D2,
                        depth_or_array_layers: 1,
                    },
                    clear_depth: None,
                    force_store: false,
                };
                let resources = render_graph_resources_mut(&mut graph);
                let id = resources.register_transient_resource_fixed(name, transient);
                render_graph_add_pass(&mut graph, Box::new(draw), &[("depth", id)])?;
                ids.push(id);
            }
        }
        let parameters = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("parameters"),
            size: u64::from(plan.parameters.size.max(16)),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let host = Host {
            device: &gpu.device,
            queue: &gpu.queue,
            pipelines,
            parameters: &parameters,
            leaves_out_layers: options.leaves_out_layers,
            imports: &imports,
            draw: options.draw,
        };
        let ids = add_plan(&mut graph, plan, &host)?;
        let mut taken = Vec::new();
        for output in &plan.outputs {
            let of = &plan.resources[output.value];
            let take = Take::new(gpu, output.name.clone(), &of.desc)?;
            taken.push((output.name.clone(), take.clone()));
            let slots = [("picture", ids[output.value][0])];
            render_graph_add_pass(&mut graph, Box::new(take), &slots)?;
        }
        render_graph_compile(&mut graph)?;
        Ok(Self {
            graph,
            plan: plan.clone(),
            sizes,
            ids,
            parameters,
            depths,
            taken,
        })
    }

    /// Writes what the nodes are told of the world.
    pub fn write_parameters(&self, gpu: &Gpu, world: &World) -> Result<(), HostError> {
        let bytes = world.parameters(&self.plan, self.sizes)?;
        gpu.queue.write_buffer(&self.parameters, 0, &bytes);
        Ok(())
    }

    /// Writes the depth maps as they look in the world.
    pub fn write_depths(&self, gpu: &Gpu, world: &World) {
        for (import, layer, samples, buffer) in &self.depths {
            let depths = world.depth(import, *layer, *samples, self.sizes);
            write(gpu, buffer, &depths);
        }
    }

    /// Writes 0 to a depth map: all is near the light.
    pub fn spoil_depth(&self, gpu: &Gpu, import: &str, layer: u32) {
        let mut depths = self.depths.iter();
        if let Some((.., buffer)) = depths.find(|it| it.0 == import && it.1 == layer) {
            write(gpu, buffer, &vec![0.0; (buffer.size() / 4) as usize]);
        }
    }

    /// Draws a frame.
    pub fn draw(&mut self, gpu: &Gpu, inputs: Inputs) -> Result<Drawn, HostError> {
        let commands = render_graph_execute(&mut self.graph, &gpu.device, &gpu.queue, &inputs)?;
        gpu.queue.submit(commands);
        let mut pictures = Vec::new();
        for (name, take) in &self.taken {
            pictures.push((name.clone(), take.texels(&gpu.read(&take.buffer)?)));
        }
        let order = inputs.recorded.into_inner();
        let order = order.unwrap_or_else(|poisoned| poisoned.into_inner());
        Ok(Drawn { pictures, order })
    }

    /// Draws the first frame of a world.
    pub fn draw_world(&mut self, gpu: &Gpu, world: &World) -> Result<Drawn, HostError> {
        self.write_parameters(gpu, world)?;
        self.write_depths(gpu, world);
        self.draw(gpu, Inputs::default())
    }

    /// Bytes of the textures and buffers that hold the plan's own resources, once a frame was drawn.
    pub fn bytes(&mut self) -> u64 {
        let (mut textures, mut bytes) = (HashSet::new(), 0);
        let resources = render_graph_resources_mut(&mut self.graph);
        for (resource, ids) in self.plan.resources.iter().zip(&self.ids) {
            if matches!(resource.home, Home::Import(_)) {
                continue;
            }
            for &id in ids {
                match resources.get_handle(id) {
                    Some(
                        ResourceHandle::TransientBuffer { buffer }
                        | ResourceHandle::ExternalBuffer { buffer },
                    ) => bytes += buffer.size(),
                    Some(handle) => textures.extend(handle.texture().cloned()),
                    None => {}
                }
            }
        }
        bytes + textures.iter().map(bytes_of).sum::<u64>()
    }
}

fn write(gpu: &Gpu, buffer: &wgpu::Buffer, depths: &[f32]) {
    let bytes: Vec<u8> = depths
        .iter()
        .flat_map(|depth| depth.to_le_bytes())
        .collect();
    gpu.queue.write_buffer(buffer, 0, &bytes);
}

/// Bytes of all levels of all layers.
fn bytes_of(texture: &wgpu::Texture) -> u64 {
    let texel = texture.format().block_copy_size(None).unwrap_or(0);
    let levels = (0..texture.mip_level_count()).map(|level| {
        let side = |side: u32| u64::from((side >> level).max(1));
        side(texture.width()) * side(texture.height())
    });
    let layers = u64::from(texture.depth_or_array_layers()) * u64::from(texture.sample_count());
    levels.sum::<u64>() * layers * u64::from(texel)
}
