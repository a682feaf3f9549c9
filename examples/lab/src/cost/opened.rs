//! A graph whose every connection is an output, so that what each node takes and gives can be read and compared.

use moment_shadows::{DepthConversion, Kernel, MapEncoding, Storage, Technique};
use moment_shadows_graph::Named;
use moment_shadows_graph::nodes::{Blur, BlurKernel};

use super::harness::Difference;
use super::reference;
use super::shading;
use super::texels::{Channels, decode};
use crate::error::LabError;
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

/// A difference from the reference, if there is one.
type Checked = Result<Option<Difference>, LabError>;

/// Channels of a mip level.
struct Level {
    storage: Storage,
    size: [usize; 2],
    channels: Channels,
}

/// The import that the lab binds the light's depth to.
const LIGHT_DEPTH: &str = "light_depth";

impl OpenedGraph {
    /// Runs the graph on the frame with its connections as further outputs.
    pub(super) fn run(gpu: &Gpu, frame: &Frame, file: &GraphFile) -> Result<Self, LabError> {
        let mut file = GraphFile::parse(&file.name, file.text.clone(), None)?;
        let given = file.graph.outputs.iter().map(|output| output.value.clone());
        // What a node changes in place is available only after it.
        let edges = file.graph.edges.iter();
        let kept = edges.filter(|edge| changes_in_place(&file, &edge.to).is_none());
        let connected = kept.map(|edge| edge.from.clone());
        let mut ends: Vec<String> = given
            .chain(connected)
            .filter(|end| end.contains('.'))
            .collect();
        ends.sort();
        ends.dedup();
        file.graph.outputs = ends
            .into_iter()
            .map(|from| Named::new(output_name(&from), from))
            .collect();
        let graph_frame = GraphFrame::new(gpu, frame, &file)?;
        graph_frame.run(gpu)?;
        Ok(Self {
            file,
            frame: graph_frame,
        })
    }

    /// How far a node's output is from the reference (for shading, in the mean of some pixels); `None` for a node without
    /// a reference.
    pub(super) fn difference(&self, gpu: &Gpu, frame: &Frame, node: &str) -> Checked {
        match self.file.node_entry(node, "type").as_str() {
            Some("resolve") => self.of_resolve(gpu, frame, node),
            Some("blur") if self.source(node, "map").is_empty() => {
                self.of_resolved_blur(gpu, frame, node)
            }
            Some("blur") => self.of_blur(gpu, node),
            Some("downsample") => self.of_downsample(gpu, node),
            Some("shade_hard") => self.of_shade(gpu, frame, node),
            _ => Ok(None),
        }
    }

    fn of_resolve(&self, gpu: &Gpu, frame: &Frame, node: &str) -> Checked {
        let depth = self.source(node, "depth");
        let output = self.held(node, "map");
        let Some(found) = self
            .level(gpu, &output, 0)?
            .filter(|_| depth == LIGHT_DEPTH)
        else {
            return Ok(None);
        };
        let depth = read_depth_samples(gpu, &frame.light_map.texture)?;
        // The harness's light is a sun whose depth is not reversed.
        let conversion = DepthConversion::orthographic();
        let reference = reference::resolve(&depth, &conversion, found.storage);
        let tolerance = reference::resolve_tolerance(found.storage, depth.samples);
        found.difference(&reference, tolerance)
    }

    fn of_blur(&self, gpu: &Gpu, node: &str) -> Checked {
        let source = self.level(gpu, &self.source(node, "map"), 0)?;
        let found = self.level(gpu, &self.held(node, "blurred"), 0)?;
        let (Some(source), Some(found)) = (source, found) else {
            return Ok(None);
        };
        let Some(kernel) = self.kernel(node) else {
            return Ok(None);
        };
        let reference = reference::blur(&source.channels, source.size, &kernel);
        found.difference(
            &reference,
            reference::blur_tolerance(found.storage, &kernel),
        )
    }

    /// A blur that resolves the light's depth by itself.
    fn of_resolved_blur(&self, gpu: &Gpu, frame: &Frame, node: &str) -> Checked {
        let found = self.level(gpu, &self.held(node, "blurred"), 0)?;
        let found = found.filter(|_| self.source(node, "depth") == LIGHT_DEPTH);
        let (Some(kernel), Some(found)) = (self.kernel(node), found) else {
            return Ok(None);
        };
        let depth = read_depth_samples(gpu, &frame.light_map.texture)?;
        let conversion = DepthConversion::orthographic();
        let resolved = reference::resolve(&depth, &conversion, found.storage);
        let reference = reference::blur(&resolved, found.size, &kernel);
        let tolerance = reference::resolved_blur_tolerance(found.storage, &kernel, depth.samples);
        found.difference(&reference, tolerance)
    }

    /// The kernel of a blur, if it has one in texels.
    fn kernel(&self, node: &str) -> Option<Kernel> {
        let properties = self.file.node_entry(node, "properties");
        let blur: Blur = serde_json::from_value(properties).ok()?;
        match blur.kernel {
            Ok(BlurKernel::Texels(kernel)) => Some(kernel),
            _ => None,
        }
    }

    /// Each mip level against the one before it, as that is stored.
    fn of_downsample(&self, gpu: &Gpu, node: &str) -> Checked {
        let output = format!("{node} map");
        let mips = self
            .frame
            .plan
            .output_texture(&output)
            .map_or(0, |desc| desc.mips);
        let mut all: Option<Difference> = None;
        for level in 1..mips {
            let finer = self.level(gpu, &output, level - 1)?;
            let (Some(finer), Some(found)) = (finer, self.level(gpu, &output, level)?) else {
                return Ok(None);
            };
            let reference = reference::downsample(&finer.channels, finer.size, found.size);
            let tolerance = reference::downsample_tolerance(found.storage);
            let next = found.difference(&reference, tolerance)?;
            all = all.into_iter().chain(next).reduce(Difference::worse);
        }
        Ok(all)
    }

    /// Only a map without mip levels: the reference looks up the finest.
    fn of_shade(&self, gpu: &Gpu, frame: &Frame, node: &str) -> Checked {
        let map = self.frame.plan.output_texture(&self.source(node, "map"));
        let output = self.held(node, "shadow_intensity");
        let Some(intensity) = self.frame.bindings.output(&output) else {
            return Ok(None);
        };
        let encoding = map.and_then(|map| map.encoding.as_ref());
        let judged = match map {
            Some(map) => map.mips == 1 && map.size == frame.desc.map && encoding.is_some(),
            None => self.file.reads_depth(),
        };
        if !judged {
            return Ok(None);
        }
        shading::difference(gpu, frame, &self.file, intensity, encoding)
    }

    /// A mip level of an output that holds four moments channel by channel; the other techniques, and packed texels, are judged by what is
    /// shaded with them.
    fn level(&self, gpu: &Gpu, output: &str, level: u32) -> Result<Option<Level>, LabError> {
        let Self { frame, .. } = self;
        let desc = frame.plan.output_texture(output);
        let (Some(desc), Some(texture)) = (desc, frame.bindings.output(output)) else {
            return Ok(None);
        };
        let four = desc
            .encoding
            .as_ref()
            .filter(|encoding| encoding.table().is_none() && !encoding.storage().is_packed());
        let Some(storage) = four.filter(holds_four_moments).map(MapEncoding::storage) else {
            return Ok(None);
        };
        Ok(Some(Level {
            storage,
            size: desc.size_at(level).map(|side| side as usize),
            channels: decode(storage, &gpu.read_level(texture, 0, level, output)?),
        }))
    }

    /// What an input of a node is connected to: the name of an output of this graph, or of an import; empty where it is
    /// open.
    fn source(&self, node: &str, slot: &str) -> String {
        let to = format!("{node}.{slot}");
        let mut edges = self.file.graph.edges.iter();
        let from = edges.find(|edge| edge.to == to).map(|edge| &edge.from);
        from.map_or(String::new(), |from| match from.split_once('.') {
            Some((node, slot)) => self.held(node, slot),
            None => from.clone(),
        })
    }

    /// The output that holds what a node gives: its own, or that of the node which changes it in place. What those have
    /// here, the finest level, they leave as it is.
    fn held(&self, node: &str, slot: &str) -> String {
        let from = format!("{node}.{slot}");
        let mut edges = self.file.graph.edges.iter();
        let changed = edges.find_map(|edge| {
            let changes = changes_in_place(&self.file, &edge.to);
            changes.filter(|_| edge.from == from)
        });
        changed.unwrap_or_else(|| format!("{node} {slot}"))
    }
}

impl Level {
    fn difference(&self, reference: &[[f64; 4]], tolerance: f64) -> Checked {
        Ok(Some(reference::difference(
            &self.channels,
            reference,
            tolerance,
        )))
    }
}

/// Whether a map is made as for Hamburger's bound of four moments.
fn holds_four_moments(encoding: &&MapEncoding) -> bool {
    (Technique::Hamburger4.row()).shares_map_with(&encoding.technique().row())
}

/// The output of the node that an edge leads to, if it is the same texture as this input.
fn changes_in_place(file: &GraphFile, to: &str) -> Option<String> {
    let (node, _) = to.split_once('.')?;
    (file.node_entry(node, "type") == "downsample").then(|| output_name(to))
}

/// The name of the output that a connection is made: `node slot`. An import keeps its name.
fn output_name(end: &str) -> String {
    end.replacen('.', " ", 1)
}
