//! One node on its own, bound to a map of any contents.

use moment_shadows_graph::record::{
    Bindings, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{
    Capabilities, Graph, GraphError, NodeRegistry, ParameterLayout, Plan, ResourceDesc, Stage,
    TextureDesc,
};
use pollster::block_on;
use serde_json::{Value, json};

use crate::error::LabError;
use crate::gpu::Gpu;
use crate::texture::upload;

/// A graph of one node.
pub(crate) struct NodeOnMap {
    pub(crate) plan: Plan,
    bindings: Bindings,
    parameters: wgpu::Buffer,
    output: &'static str,
}

/// What a graph of one node is made of.
pub(crate) struct NodeText {
    /// The node's type, and its name in the graph.
    pub(crate) node: &'static str,
    /// Its properties.
    pub(crate) properties: Value,
    /// The slot that reads the import `map`, and the slot whose contents are wanted.
    pub(crate) slots: [&'static str; 2],
}

impl NodeText {
    /// The graph, compiled for a map.
    pub(crate) fn plan(
        &self,
        capabilities: &Capabilities,
        map: &TextureDesc,
    ) -> Result<Plan, GraphError> {
        let (node, [input, output]) = (self.node, self.slots);
        let text = json!({
            "version": 2,
            "imports": [{ "name": "map" }],
            "nodes": [{ "name": node, "type": node, "properties": self.properties }],
            "edges": [{ "from": "map", "to": format!("{node}.{input}") }],
            "outputs": [{ "name": output, "from": format!("{node}.{output}") }]
        });
        let graph = Graph::parse(&text.to_string(), &NodeRegistry::new())?;
        graph.compile(capabilities, &[("map", ResourceDesc::Texture(map.clone()))])
    }
}

impl NodeOnMap {
    /// Compiles the graph and binds it to a map with these bytes, layer by layer and row by row, and to its initial parameters.
    pub(crate) fn new(
        gpu: &Gpu,
        capabilities: &Capabilities,
        text: &NodeText,
        map: &TextureDesc,
        bytes: &[u8],
    ) -> Result<Self, LabError> {
        let plan = text
            .plan(capabilities, map)
            .map_err(LabError::graph(text.node))?;
        let device = &gpu.device;
        let pipelines = block_on(Pipelines::create(device, &plan, PipelineOptions::default()))?;
        let resources = block_on(Resources::create(device, &plan))?;
        let parameters = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("lab/parameters"),
            // Nor may a buffer for no parameters be empty.
            size: u64::from(plan.parameters.size.max(16)),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let map = upload(gpu, map, bytes);
        let bindings = block_on(Bindings::create(
            device,
            &plan,
            &pipelines,
            &resources,
            &[("map", ImportedResource::from(&map))],
            Some(&parameters),
        ))?;
        let node = Self {
            plan,
            bindings,
            parameters,
            output: text.slots[1],
        };
        node.fill(gpu, |_, _| Ok(()))?;
        Ok(node)
    }

    /// Writes the parameters: the initial ones, which `change` may write over.
    pub(crate) fn fill(
        &self,
        gpu: &Gpu,
        change: impl FnOnce(&ParameterLayout, &mut [u8]) -> Result<(), LabError>,
    ) -> Result<(), LabError> {
        let mut block = self.plan.parameters.initial();
        change(&self.plan.parameters, &mut block)?;
        gpu.queue.write_buffer(&self.parameters, 0, &block);
        Ok(())
    }

    /// Records the passes and layers of a recording.
    pub(crate) fn record(
        &self,
        recording: Recording<'_>,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), LabError> {
        Ok(self
            .bindings
            .record(Stage::AfterShadowMaps, encoder, recording)?)
    }

    /// Bytes that all passes read and write.
    pub(crate) fn bytes(&self) -> [u64; 2] {
        let passes = || self.plan.passes.iter();
        [
            passes().map(|pass| pass.bytes_read).sum(),
            passes().map(|pass| pass.bytes_written).sum(),
        ]
    }

    /// Runs the node once.
    pub(crate) fn run(&self, gpu: &Gpu, recording: Recording<'_>) -> Result<(), LabError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.record(recording, &mut encoder)?;
        gpu.queue.submit([encoder.finish()]);
        gpu.check()
    }

    /// The texture that the node writes.
    pub(crate) fn output(&self) -> Result<&wgpu::Texture, LabError> {
        let output = self.bindings.output(self.output);
        output.ok_or_else(|| LabError::unsuitable(self.output, "the plan has no such output"))
    }

    /// What the output holds now, layer by layer.
    pub(crate) fn read(&self, gpu: &Gpu) -> Result<Vec<Vec<u8>>, LabError> {
        let output = self.output()?;
        let read = |layer| gpu.read_texture(output, layer, self.output);
        let layers = 0..output.depth_or_array_layers();
        layers.map(read).collect()
    }

    /// Runs the node once and reads its output, layer by layer.
    pub(crate) fn made(&self, gpu: &Gpu) -> Result<Vec<Vec<u8>>, LabError> {
        self.run(gpu, Recording::default())?;
        self.read(gpu)
    }
}
