//! A graph whose every connection is an output, so that what each node takes and gives can be read and compared.

use moment_shadows::{DepthConversion, Storage};
use moment_shadows_graph::nodes::KernelProperty;
use moment_shadows_graph::{Endpoint, Output};

use super::CostError;
use super::reference;
use super::shading;
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
        // What a node changes in place can be had only after it.
        let edges = file.graph.edges.iter();
        let kept = edges.filter(|edge| changes_in_place(&file, &edge.to).is_none());
        let connected = kept.map(|edge| edge.from.clone());
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

    /// Compares a node's output with the reference, and gives the largest error (for shading, the mean error of some
    /// pixels); `None` for a node without a reference.
    pub(super) fn check(
        &self,
        gpu: &Gpu,
        frame: &Frame,
        node: &str,
    ) -> Result<Option<f64>, CostError> {
        match self.file.node_entry(node, "type").as_str() {
            Some("resolve") => self.check_resolve(gpu, frame, node),
            Some("blur") => self.check_blur(gpu, node),
            Some("downsample") => self.check_downsample(gpu, node),
            Some("shade_hard") => self.check_shade(gpu, frame, node),
            _ => Ok(None),
        }
    }

    fn check_resolve(
        &self,
        gpu: &Gpu,
        frame: &Frame,
        node: &str,
    ) -> Result<Option<f64>, CostError> {
        let Some((storage, moments)) = self.moments(gpu, &self.held(node, "map"))? else {
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
        let Some(source) = self.source(node, "map") else {
            return Ok(None);
        };
        let (Some((storage, moments)), Some((_, blurred))) = (
            self.moments(gpu, &source)?,
            self.moments(gpu, &self.held(node, "blurred"))?,
        ) else {
            return Ok(None);
        };
        let kernel: KernelProperty =
            serde_json::from_value(self.file.node_entry(node, "properties")["kernel"].clone())
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

    /// Each mip level against the one before it, as that is stored.
    fn check_downsample(&self, gpu: &Gpu, node: &str) -> Result<Option<f64>, CostError> {
        let output = format!("{node} moments");
        let Some(desc) = self.frame.plan.output_texture(&output).cloned() else {
            return Ok(None);
        };
        let mut largest = 0.0_f64;
        let Some((storage, mut finer)) = self.level(gpu, &output, 0)? else {
            return Ok(None);
        };
        let size = |level: u32| desc.size_at(level).map(|side| side as usize);
        for level in 1..desc.mips {
            let reference = reference::downsample(&finer, size(level - 1), size(level));
            let Some((_, found)) = self.level(gpu, &output, level)? else {
                return Ok(None);
            };
            let what = format!("{node}, mip level {level}");
            let tolerance = reference::downsample_tolerance(storage);
            largest = largest.max(reference::check(&what, &found, &reference, tolerance)?);
            finer = found;
        }
        Ok(Some(largest))
    }

    /// Only a map without mip levels: the reference looks up the finest.
    fn check_shade(&self, gpu: &Gpu, frame: &Frame, node: &str) -> Result<Option<f64>, CostError> {
        let map = self.source(node, "map");
        let map = map.and_then(|map| self.frame.plan.output_texture(&map));
        let intensity = self
            .frame
            .bindings
            .output(&self.held(node, "shadow_intensity"));
        let (Some(map), Some(intensity)) = (map, intensity) else {
            return Ok(None);
        };
        if map.mips > 1 || map.size != frame.desc.map {
            return Ok(None);
        }
        let storage =
            Storage::of_format(map.format).ok_or(CostError::Format { format: map.format })?;
        shading::check(gpu, frame, &self.file, (node, intensity), storage)
    }

    /// The stored channels of an output that holds moments.
    fn moments(&self, gpu: &Gpu, output: &str) -> Result<Option<(Storage, Channels)>, CostError> {
        self.level(gpu, output, 0)
    }

    /// The same of one of its mip levels.
    fn level(
        &self,
        gpu: &Gpu,
        output: &str,
        level: u32,
    ) -> Result<Option<(Storage, Channels)>, CostError> {
        let (Some(desc), Some(texture)) = (
            self.frame.plan.output_texture(output),
            self.frame.bindings.output(output),
        ) else {
            return Ok(None);
        };
        let storage = Storage::of_format(desc.format).ok_or(CostError::Format {
            format: desc.format,
        })?;
        let bytes = gpu.read_level(texture, 0, level, output)?;
        Ok(Some((storage, decode(storage, &bytes))))
    }

    /// What an input of a node is connected to: the name of an output of this graph, or of an import.
    fn source(&self, node: &str, slot: &str) -> Option<String> {
        let to = format!("{node}.{slot}");
        let edges = &self.file.graph.edges;
        let edge = edges.iter().find(|edge| edge.to.to_string() == to)?;
        Some(match &edge.from.slot {
            Some(slot) => self.held(&edge.from.owner, slot),
            None => output_name(&edge.from),
        })
    }

    /// The output that holds what a node gives: its own, or that of the node which changes it in place. What those have
    /// here, the finest level, they leave as it is.
    fn held(&self, node: &str, slot: &str) -> String {
        let from = format!("{node}.{slot}");
        let mut edges = self.file.graph.edges.iter();
        let changed = edges.find_map(|edge| {
            let changes = changes_in_place(&self.file, &edge.to);
            changes.filter(|_| edge.from.to_string() == from)
        });
        changed.unwrap_or_else(|| format!("{node} {slot}"))
    }
}

/// The output of the node that an edge leads to, if it is the same texture as this input.
fn changes_in_place(file: &GraphFile, to: &Endpoint) -> Option<String> {
    (file.node_entry(&to.owner, "type") == "downsample").then(|| output_name(to))
}

/// The name of the output that a connection is made: `node slot`. An import keeps its name.
fn output_name(end: &Endpoint) -> String {
    match &end.slot {
        Some(slot) => format!("{} {slot}", end.owner),
        None => end.owner.clone(),
    }
}
