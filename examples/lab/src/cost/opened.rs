//! A graph whose every connection is an output, so that what each node takes and gives can be read and compared.

use moment_shadows::{DepthConversion, Storage};
use moment_shadows_graph::nodes::KernelProperty;
use moment_shadows_graph::{Endpoint, Output};
use serde_json::Value;

use super::CostError;
use super::reference;
use super::texels::{Channels, decode};
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;
use crate::host::read_depth_samples;

/// The graph, after it has run.
pub(super) struct OpenedGraph {
    file: GraphFile,
    frame: GraphFrame,
}

/// The import that the lab binds the light's depth to.
const LIGHT_DEPTH: &str = "light_depth";

impl OpenedGraph {
    /// Runs the graph on the frame with its connections as further outputs.
    pub(super) fn run(gpu: &Gpu, frame: &Frame, file: &GraphFile) -> Result<Self, CostError> {
        let mut file = GraphFile::parse(&file.name, file.text.clone(), None)?;
        let given = file.graph.outputs.iter().map(|output| output.from.clone());
        let connected = file.graph.edges.iter().map(|edge| edge.from.clone());
        let mut ends: Vec<Endpoint> = given
            .chain(connected)
            .filter(|end| end.slot.is_some())
            .collect();
        ends.sort();
        ends.dedup();
        file.graph.outputs = ends
            .into_iter()
            .map(|from| Output {
                name: output_name(&from),
                from,
                position: None,
            })
            .collect();
        let graph_frame = GraphFrame::new(gpu, frame, &file)?;
        graph_frame.run(gpu)?;
        Ok(Self {
            file,
            frame: graph_frame,
        })
    }

    /// Compares a node's output with the reference, and gives the largest error; `None` for a node without a reference.
    pub(super) fn check(
        &self,
        gpu: &Gpu,
        frame: &Frame,
        node: &str,
    ) -> Result<Option<f64>, CostError> {
        match self.property(node, "type").as_str() {
            Some("resolve_moments") => self.check_resolve(gpu, frame, node),
            Some("blur_moments") => self.check_blur(gpu, node),
            _ => Ok(None),
        }
    }

    fn check_resolve(
        &self,
        gpu: &Gpu,
        frame: &Frame,
        node: &str,
    ) -> Result<Option<f64>, CostError> {
        let Some((storage, moments)) = self.moments(gpu, &format!("{node} moments"))? else {
            return Ok(None);
        };
        if self.source(node, "depth") != Some(LIGHT_DEPTH.to_owned()) {
            return Ok(None);
        }
        let depth = read_depth_samples(gpu, &frame.light_map.texture)
            .map_err(crate::error::LabError::from)?;
        // The harness's light is a sun whose depth is not reversed.
        let conversion = DepthConversion::orthographic();
        let reference = reference::resolve(&depth, &conversion, storage);
        let tolerance = reference::resolve_tolerance(storage, depth.samples);
        reference::check(node, &moments, &reference, tolerance).map(Some)
    }

    fn check_blur(&self, gpu: &Gpu, node: &str) -> Result<Option<f64>, CostError> {
        let Some(source) = self.source(node, "moments") else {
            return Ok(None);
        };
        let (Some((storage, moments)), Some((_, blurred))) = (
            self.moments(gpu, &source)?,
            self.moments(gpu, &format!("{node} blurred"))?,
        ) else {
            return Ok(None);
        };
        let kernel: KernelProperty =
            serde_json::from_value(self.property(node, "properties")["kernel"].clone())
                .unwrap_or_default();
        let kernel = kernel.kernel()?;
        let size = self
            .frame
            .plan
            .output_texture(&source)
            .map_or([0; 2], |desc| desc.size.map(|side| side as usize));
        let reference = reference::blur(&moments, size, &kernel);
        let tolerance = reference::blur_tolerance(storage, &kernel);
        reference::check(node, &blurred, &reference, tolerance).map(Some)
    }

    /// The stored channels of an output that holds moments.
    fn moments(&self, gpu: &Gpu, output: &str) -> Result<Option<(Storage, Channels)>, CostError> {
        let (Some(desc), Some(texture)) = (
            self.frame.plan.output_texture(output),
            self.frame.bindings.output(output),
        ) else {
            return Ok(None);
        };
        let storage = Storage::of_format(desc.format).ok_or(CostError::Format {
            format: desc.format,
        })?;
        let bytes = gpu.read_texture(texture, 0, output)?;
        Ok(Some((storage, decode(storage, &bytes))))
    }

    /// What an input of a node is connected to: the name of an output of this graph, or of an import.
    fn source(&self, node: &str, slot: &str) -> Option<String> {
        let to = format!("{node}.{slot}");
        let edges = &self.file.graph.edges;
        let edge = edges.iter().find(|edge| edge.to.to_string() == to)?;
        Some(output_name(&edge.from))
    }

    /// An entry of a node in the graph file, whose text has been parsed before.
    fn property(&self, node: &str, property: &str) -> Value {
        let file: Value = serde_json::from_str(&self.file.text).unwrap_or_default();
        let nodes = file["nodes"].as_array().cloned().unwrap_or_default();
        nodes
            .into_iter()
            .find(|candidate| candidate["name"] == node)
            .map_or(Value::Null, |found| found[property].clone())
    }
}

/// The name of the output that a connection is made: `node slot`. An import keeps its name.
fn output_name(end: &Endpoint) -> String {
    match &end.slot {
        Some(slot) => format!("{} {slot}", end.owner),
        None => end.owner.clone(),
    }
}
