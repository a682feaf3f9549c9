//! What the device has fitted a map's depths to.

use crate::error::LabError;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;

/// Middle and scale of a range within the host's, `RangeFit` of the shader.
pub(super) type RangeFit = [f32; 2];

/// The host's range itself.
pub(super) const HOSTS_RANGE: RangeFit = [0.0, 1.0];

/// The output with the ranges of a graph's map, so that it can be evaluated elsewhere.
pub(super) struct FittedRange(String);

impl FittedRange {
    /// The graph with its ranges as an output; the graph as it is, and none, where no node fits them.
    pub(super) fn of(file: GraphFile) -> Result<(GraphFile, Option<Self>), LabError> {
        let Some(node) = file.node_of("fit_range") else {
            return Ok((file, None));
        };
        let slot = format!("{}.ranges", node["name"].as_str().unwrap_or_default());
        let (file, output) = file.with_output(&slot, "lab_ranges")?;
        Ok((file, Some(Self(output))))
    }

    /// Reads it after a run.
    pub(super) fn read(&self, gpu: &Gpu, graph: &GraphFrame) -> Result<RangeFit, LabError> {
        let Some(texture) = graph.bindings.output(&self.0) else {
            return Ok(HOSTS_RANGE);
        };
        let bytes = gpu.read_texture(texture, 0, &self.0)?;
        let texel: Vec<f32> = bytemuck::pod_collect_to_vec(&bytes);
        Ok([texel[0], texel[1]])
    }
}
