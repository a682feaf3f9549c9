//! A map of any contents and its summed-area table.

use moment_shadows::MapRegion;
use moment_shadows_graph::record::{
    Bindings, ImportedResource, Layers, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{
    Capabilities, Graph, GraphError, NodeRegistry, Plan, ResourceDesc, Stage, TextureDesc,
};
use pollster::block_on;
use wgpu::util::DeviceExt;

use crate::error::LabError;
use crate::gpu::Gpu;

/// What errors name.
const NAME: &str = "summed-area table";

/// A plan without a table.
pub(super) fn no_table() -> LabError {
    LabError::unsuitable(
        NAME,
        "the plan has no output 'table'; make one of a graph that does",
    )
}

/// A map, its table and what makes it.
pub struct SummedMap {
    plan: Plan,
    bindings: Bindings,
    parameters: wgpu::Buffer,
}

impl SummedMap {
    /// Compiles a graph of one table and binds it to a map with these bytes, layer by layer and row by row.
    pub fn new(
        gpu: &Gpu,
        capabilities: &Capabilities,
        desc: &TextureDesc,
        bytes: &[u8],
        largest_kernel: [u32; 2],
    ) -> Result<Self, LabError> {
        let plan =
            Self::plan(capabilities, desc, largest_kernel).map_err(|error| LabError::Graph {
                file: NAME.to_owned(),
                error,
            })?;
        let device = &gpu.device;
        let pipelines = block_on(Pipelines::create(device, &plan, PipelineOptions::default()))?;
        let resources = block_on(Resources::create(device, &plan))?;
        let parameters = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("summed area/parameters"),
            contents: &plan.parameters.initial(),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
        });
        let moments = moments_texture(gpu, desc, bytes);
        let bindings = block_on(Bindings::create(
            device,
            &plan,
            &pipelines,
            &resources,
            &[("map", ImportedResource::Texture(&moments))],
            Some(&parameters),
        ))?;
        Ok(Self {
            plan,
            bindings,
            parameters,
        })
    }

    /// The plan alone.
    pub fn plan(
        capabilities: &Capabilities,
        desc: &TextureDesc,
        largest_kernel: [u32; 2],
    ) -> Result<Plan, GraphError> {
        let text = serde_json::json!({
            "version": 2,
            "imports": [{ "name": "map" }],
            "nodes": [{
                "name": "sum",
                "type": "summed_area_table",
                "properties": { "largest_kernel": largest_kernel }
            }],
            "edges": [{ "from": "map", "to": "sum.map" }],
            "outputs": [{ "name": "table", "from": "sum.table" }]
        });
        let graph = Graph::parse(&text.to_string(), &NodeRegistry::new())?;
        let imports = [("map", ResourceDesc::Texture(desc.clone()))];
        graph.compile(capabilities, &imports)
    }

    /// What is known of the table: its encoding says what its integers mean.
    #[must_use]
    pub fn desc(&self) -> Option<&TextureDesc> {
        self.plan.output_texture("table")
    }

    /// The table.
    #[must_use]
    pub fn table(&self) -> Option<&wgpu::Texture> {
        self.bindings.output("table")
    }

    /// Bytes that all passes move.
    #[must_use]
    pub fn bytes_moved(&self) -> u64 {
        self.plan.bytes_moved()
    }

    /// From now on a layer has these regions.
    pub fn set_regions(
        &self,
        gpu: &Gpu,
        layer: u32,
        regions: &[MapRegion],
    ) -> Result<(), LabError> {
        let mut block = self.plan.parameters.initial();
        self.plan
            .parameters
            .write_regions(&mut block, "map", layer, regions)?;
        gpu.queue.write_buffer(&self.parameters, 0, &block);
        Ok(())
    }

    /// Records all passes for some layers.
    pub fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        layers: Layers<'_>,
    ) -> Result<(), GraphError> {
        let recording = Recording {
            layers,
            ..Recording::default()
        };
        self.bindings
            .record(Stage::AfterShadowMaps, encoder, recording)
    }

    /// Makes the table of some layers.
    pub fn run(&self, gpu: &Gpu, layers: Layers<'_>) -> Result<(), LabError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.record(&mut encoder, layers)?;
        gpu.queue.submit([encoder.finish()]);
        gpu.check()
    }

    /// The integers of a layer, all channels of a texel after the other.
    pub fn read(&self, gpu: &Gpu, layer: u32) -> Result<Vec<u32>, LabError> {
        let table = self.table().ok_or_else(no_table)?;
        let bytes = gpu.read_texture(table, layer, "summed-area table")?;
        Ok(bytemuck::pod_collect_to_vec(&bytes))
    }
}

/// The map as a texture.
pub(super) fn moments_texture(gpu: &Gpu, desc: &TextureDesc, bytes: &[u8]) -> wgpu::Texture {
    gpu.device.create_texture_with_data(
        &gpu.queue,
        &wgpu::TextureDescriptor {
            label: Some("summed area/moments"),
            size: wgpu::Extent3d {
                width: desc.size[0],
                height: desc.size[1],
                depth_or_array_layers: desc.layers,
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
