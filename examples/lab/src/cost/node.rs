//! One node on its own, bound to a map of any contents.

use moment_shadows_graph::record::{
    Bindings, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{
    Capabilities, Graph, GraphError, NodeRegistry, Plan, ResourceDesc, Stage, TextureDesc,
};
use pollster::block_on;
use serde_json::Value;
use wgpu::util::DeviceExt;

use super::CostError;
use crate::gpu::Gpu;

/// A graph of one node.
pub(super) struct NodeOnMap {
    plan: Plan,
    bindings: Bindings,
}

/// What a graph of one node is made of.
pub(super) struct NodeText {
    /// The node's type.
    pub node_type: &'static str,
    /// Its properties.
    pub properties: Value,
    /// The slot that reads the map.
    pub input: &'static str,
    /// The slot whose contents are wanted.
    pub output: &'static str,
}

impl NodeOnMap {
    /// Compiles the graph and binds it to a map and to parameters, which `fill` writes over the initial ones.
    pub(super) fn new(
        gpu: &Gpu,
        capabilities: &Capabilities,
        text: NodeText,
        map: (&TextureDesc, &wgpu::Texture),
        fill: impl FnOnce(&Plan, &mut [u8]) -> Result<(), GraphError>,
    ) -> Result<Self, CostError> {
        let json = serde_json::json!({
            "version": 2,
            "imports": [{ "name": "map" }],
            "nodes": [{ "name": "node", "type": text.node_type, "properties": text.properties }],
            "edges": [{ "from": "map", "to": format!("node.{}", text.input) }],
            "outputs": [{ "name": "output", "from": format!("node.{}", text.output) }]
        });
        let graph = Graph::parse(&json.to_string(), &NodeRegistry::new())?;
        let imports = [("map", ResourceDesc::Texture(map.0.clone()))];
        let plan = graph.compile(capabilities, &imports)?;
        let device = &gpu.device;
        let pipelines = block_on(Pipelines::create(device, &plan, PipelineOptions::default()))?;
        let resources = block_on(Resources::create(device, &plan))?;
        let mut block = plan.parameters.initial();
        fill(&plan, &mut block)?;
        // Nor may a buffer for no parameters be empty.
        block.extend([0; 16]);
        let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("cost/parameters"),
            contents: &block,
            usage: wgpu::BufferUsages::UNIFORM,
        });
        let bindings = block_on(Bindings::create(
            device,
            &plan,
            &pipelines,
            &resources,
            &[("map", ImportedResource::Texture(map.1))],
            Some(&buffer),
        ))?;
        Ok(Self { plan, bindings })
    }

    /// Records some of its passes for all layers.
    pub(super) fn record(
        &self,
        passes: Option<&[usize]>,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), CostError> {
        let recording = Recording {
            passes,
            ..Recording::default()
        };
        Ok(self
            .bindings
            .record(Stage::AfterShadowMaps, encoder, recording)?)
    }

    /// Bytes that all passes read and write.
    pub(super) fn bytes(&self) -> [u64; 2] {
        let passes = self.plan.passes.iter();
        let [read, written] = [passes.clone(), passes];
        [
            read.map(|pass| pass.bytes_read).sum(),
            written.map(|pass| pass.bytes_written).sum(),
        ]
    }

    /// Runs the node once and reads its output, layer by layer.
    pub(super) fn run(&self, gpu: &Gpu) -> Result<Vec<Vec<u8>>, CostError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.record(None, &mut encoder)?;
        gpu.queue.submit([encoder.finish()]);
        self.read(gpu)
    }

    /// What the output holds now, layer by layer.
    pub(super) fn read(&self, gpu: &Gpu) -> Result<Vec<Vec<u8>>, CostError> {
        let Some(output) = self.bindings.output("output") else {
            return Ok(Vec::new());
        };
        let layers = 0..output.depth_or_array_layers();
        let read = |layer| gpu.read_texture(output, layer, "output");
        Ok(layers.map(read).collect::<Result<_, _>>()?)
    }
}

/// A texture with these bytes, layer by layer and row by row.
pub(super) fn upload(gpu: &Gpu, desc: &TextureDesc, bytes: &[u8]) -> wgpu::Texture {
    gpu.device.create_texture_with_data(
        &gpu.queue,
        &wgpu::TextureDescriptor {
            label: Some("cost/map"),
            size: wgpu::Extent3d {
                width: desc.size[0],
                height: desc.size[1],
                depth_or_array_layers: desc.array_layers(),
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: desc.wgpu_format(),
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        },
        wgpu::util::TextureDataOrder::LayerMajor,
        bytes,
    )
}
