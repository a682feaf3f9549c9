//! Where the device has placed the layers of a layered variance shadow map.

use moment_shadows::{Finite, LayerSplits, Technique, ValueError};

use crate::error::LabError;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;

/// Splits that a graph gives out, so that its map can be evaluated elsewhere.
pub(super) struct PlacedLayers {
    output: String,
    /// Moment depths behind the layers, the missing ones at the far end.
    splits: Vec<f32>,
}

impl PlacedLayers {
    /// The graph with its splits as an output; the graph as it is, and none, where no node places layers.
    pub(super) fn of(file: GraphFile) -> Result<(GraphFile, Option<Self>), LabError> {
        let Some(node) = file.node_of("place_layers") else {
            return Ok((file, None));
        };
        let slot = format!("{}.splits", node["name"].as_str().unwrap_or_default());
        let (file, output) = file.with_output(&slot, "lab_splits")?;
        let splits = Vec::new();
        Ok((file, Some(Self { output, splits })))
    }

    /// Reads them after a run.
    pub(super) fn read(&mut self, gpu: &Gpu, graph: &GraphFrame) -> Result<(), LabError> {
        let Some(texture) = graph.bindings.output(&self.output) else {
            return Ok(());
        };
        let bytes = gpu.read_texture(texture, 0, &self.output)?;
        self.splits = bytemuck::pod_collect_to_vec(&bytes);
        Ok(())
    }

    /// The technique with these splits given.
    pub(super) fn technique(&self, placed: &Technique) -> Result<Technique, ValueError> {
        let mut known = placed.clone();
        if let Technique::Lvsm { layers, splits, .. } = &mut known {
            let count = layers.saturating_sub(1) as usize;
            let given = self.splits.iter().copied().take(count).map(Finite::new);
            *splits = LayerSplits::Given(given.collect::<Result<_, _>>()?);
        }
        Ok(known)
    }
}
