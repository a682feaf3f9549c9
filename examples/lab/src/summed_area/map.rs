//! A map of any contents and its summed-area table.

use moment_shadows::MapRegion;
use moment_shadows_graph::record::{Layers, Recording};
use moment_shadows_graph::{Capabilities, GraphError, Plan, TextureDesc};
use serde_json::json;

use crate::error::LabError;
use crate::gpu::Gpu;
use crate::node_on_map::{NodeOnMap, NodeText};

/// A map, its table and what makes it.
pub struct SummedMap(NodeOnMap);

/// The node with a bound of its filters.
pub(crate) fn node(largest_kernel: [u32; 2]) -> NodeText {
    NodeText {
        node: "summed_area_table",
        properties: json!({ "largest_kernel": largest_kernel }),
        slots: ["map", "table"],
    }
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
        let node = NodeOnMap::new(gpu, capabilities, &node(largest_kernel), desc, bytes)?;
        Ok(Self(node))
    }

    /// The plan alone.
    pub fn plan(
        capabilities: &Capabilities,
        desc: &TextureDesc,
        largest_kernel: [u32; 2],
    ) -> Result<Plan, GraphError> {
        node(largest_kernel).plan(capabilities, desc)
    }

    /// What is known of the table: its encoding says what its integers mean.
    #[must_use]
    pub fn desc(&self) -> Option<&TextureDesc> {
        self.0.plan.output_texture("table")
    }

    /// The table.
    pub fn table(&self) -> Result<&wgpu::Texture, LabError> {
        self.0.output()
    }

    /// From now on a layer has these regions.
    pub fn set_regions(
        &self,
        gpu: &Gpu,
        layer: u32,
        regions: &[MapRegion],
    ) -> Result<(), LabError> {
        self.0.fill(gpu, |parameters, block| {
            Ok(parameters.write_regions(block, "map", layer, regions)?)
        })
    }

    /// Makes the table of some layers.
    pub fn run(&self, gpu: &Gpu, layers: Layers<'_>) -> Result<(), LabError> {
        let recording = Recording {
            layers,
            ..Recording::default()
        };
        self.0.run(gpu, recording)
    }

    /// The integers of a layer, all channels of a texel after the other.
    pub fn read(&self, gpu: &Gpu, layer: u32) -> Result<Vec<u32>, LabError> {
        let bytes = gpu.read_texture(self.table()?, layer, "summed-area table")?;
        Ok(bytemuck::pod_collect_to_vec(&bytes))
    }
}
