//! A compiled graph: passes in order, resources, memory and parameters, as data that any host can record.

use core::fmt;
use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::{Access, ResourceDesc, Stage, TextureDesc};

/// All that a host needs to record a graph.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The version of this format.
    pub version: u32,
    /// The index of the bind group that all passes use; lower ones are empty.
    pub bind_group: u32,
    /// The passes, in the order in which they are recorded.
    pub passes: Vec<PlannedPass>,
    /// Every resource that a pass touches.
    pub resources: Vec<PlannedResource>,
    /// The textures and buffers to create; resources whose lives do not overlap share one.
    pub memory: Vec<PlannedMemory>,
    /// What the host gives, in the order of the graph file; only what a pass touches.
    pub imports: Vec<PlannedImport>,
    /// What the host takes.
    pub outputs: Vec<PlannedOutput>,
    /// Where each node's uniform data lies in a view's block.
    pub parameters: ParameterLayout,
}

/// A pass with everything resolved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannedPass {
    /// The node's name in the graph.
    pub node: String,
    /// The pass's name within the node.
    pub label: String,
    /// When it is recorded.
    pub stage: Stage,
    /// Linked WGSL; empty for a host's pass.
    pub wgsl: String,
    /// The compute or fragment entry point.
    pub entry_point: String,
    /// Values of `override` constants.
    pub constants: BTreeMap<String, f64>,
    /// What the bindings hold.
    pub bindings: Vec<PlannedBinding>,
    /// What is recorded.
    pub work: PlannedWork,
    /// How often it is recorded when every layer is dirty.
    pub layers: u32,
    /// Whether it is recorded once per dirty layer; otherwise once per stage.
    pub each_layer: bool,
    /// Bytes read when every layer is dirty, each texel once.
    pub bytes_read: u64,
    /// Bytes written when every layer is dirty.
    pub bytes_written: u64,
}

/// A binding with its resource.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannedBinding {
    /// The binding's index.
    pub binding: u32,
    /// What it holds.
    pub resource: PlannedBindingResource,
}

/// What a binding holds; `resource` and `block` are indices into the plan.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PlannedBindingResource {
    /// A uniform buffer with a dynamic offset.
    Parameters {
        /// Index into the blocks of [`Plan::parameters`].
        block: usize,
        /// Bytes.
        size: u32,
    },
    /// A texture that is loaded or sampled.
    Texture {
        /// Index into [`Plan::resources`].
        resource: usize,
        /// A view of one layer, the one that the pass is recorded for; otherwise an array view of all.
        one_layer: bool,
        /// What a load gives.
        sample: SampleType,
        /// Whether texels have several samples.
        multisampled: bool,
    },
    /// Mip level 0 of one layer of a texture that is written.
    StorageTexture {
        /// Index into [`Plan::resources`].
        resource: usize,
    },
    /// A storage buffer.
    Buffer {
        /// Index into [`Plan::resources`].
        resource: usize,
        /// Whether it is written.
        writable: bool,
    },
    /// A sampler that clamps to the edge.
    Sampler {
        /// Linear; otherwise nearest.
        filtering: bool,
    },
}

/// What loading from a texture gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SampleType {
    /// Depth.
    Depth,
    /// Floating point, can be sampled with filtering.
    Filterable,
    /// Floating point, loaded only.
    Unfilterable,
}

/// What a pass records.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PlannedWork {
    /// A dispatch.
    Compute {
        /// Workgroups in x and y.
        workgroups: [u32; 2],
    },
    /// A triangle over the whole of a target.
    Fullscreen {
        /// Index into [`Plan::resources`].
        target: usize,
    },
    /// A hole where the host draws.
    Host {
        /// Colour targets, indices into [`Plan::resources`].
        targets: Vec<usize>,
        /// Whether the host blends.
        blend: bool,
        /// Depth target, index into [`Plan::resources`].
        depth: Option<usize>,
    },
}

/// A resource.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannedResource {
    /// `node.slot`, or the import's name.
    pub name: String,
    /// What it is.
    pub desc: ResourceDesc,
    /// How passes touch it.
    pub access: Access,
    /// Where it lives.
    pub home: Home,
}

/// Where a resource lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Home {
    /// The host's: index into [`Plan::imports`].
    Import(usize),
    /// The plan's: index into [`Plan::memory`].
    Memory(usize),
}

/// A texture or buffer to create.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannedMemory {
    /// The names of the resources that live in it, one after the other.
    pub label: String,
    /// What it is.
    pub desc: ResourceDesc,
    /// What it has to allow.
    pub access: Access,
    /// Whether the host takes it as an output, and may copy from it.
    pub exported: bool,
}

/// A resource that the host gives.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannedImport {
    /// The name.
    pub name: String,
    /// Index into [`Plan::resources`].
    pub resource: usize,
}

/// A resource that the host takes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannedOutput {
    /// The name.
    pub name: String,
    /// Index into [`Plan::resources`].
    pub resource: usize,
}

/// Where uniform data lies in the block of one view. A host keeps one block per view in a buffer of its own.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ParameterLayout {
    /// Bytes of one view's block; blocks of several views follow each other at multiples of this.
    pub size: u32,
    /// The blocks of the nodes.
    pub blocks: Vec<PlannedParameters>,
}

/// Where a node's uniform data lies.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlannedParameters {
    /// The node's name in the graph.
    pub node: String,
    /// The WGSL struct's name.
    pub name: String,
    /// Bytes from the start of the view's block.
    pub offset: u32,
    /// Bytes of one struct.
    pub size: u32,
    /// Bytes from one layer's struct to the next.
    pub stride: u32,
    /// How many structs there are: one, or one per layer.
    pub count: u32,
    /// What each struct holds until the host writes something else; zeros where empty.
    pub initial: Vec<u8>,
}

/// Uniform data that does not fit its place.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ParameterError {
    /// No recorded pass of that node has parameters.
    #[error("node '{node}' has no parameters in this plan; nodes that do: {known}")]
    UnknownNode {
        /// The node that was named.
        node: String,
        /// The nodes with parameters.
        known: String,
    },
    /// The struct has another size.
    #[error("parameters of node '{node}' ({name}) have {expected} bytes, {given} were given")]
    Size {
        /// The node.
        node: String,
        /// The WGSL struct.
        name: String,
        /// The struct's size.
        expected: u32,
        /// What was given.
        given: usize,
    },
    /// There are fewer layers.
    #[error("node '{node}' has parameters for {count} layers; layer {layer} is none of them")]
    Layer {
        /// The node.
        node: String,
        /// How many structs there are.
        count: u32,
        /// The layer that was named.
        layer: u32,
    },
    /// The view's block is too small.
    #[error("a view's block has {expected} bytes, {given} were given")]
    Block {
        /// [`ParameterLayout::size`].
        expected: u32,
        /// What was given.
        given: usize,
    },
}

impl ParameterLayout {
    /// A view's block with every node's initial values.
    #[must_use]
    pub fn initial(&self) -> Vec<u8> {
        let mut bytes = vec![0; self.size as usize];
        for block in &self.blocks {
            for index in 0..block.count {
                let start = (block.offset + index * block.stride) as usize;
                bytes[start..start + block.initial.len()].copy_from_slice(&block.initial);
            }
        }
        bytes
    }

    /// Writes a node's struct (for `layer`, where there is one per layer) into a view's block.
    pub fn write<P: bytemuck::NoUninit>(
        &self,
        block: &mut [u8],
        node: &str,
        layer: u32,
        parameters: &P,
    ) -> Result<(), ParameterError> {
        let planned = self
            .blocks
            .iter()
            .find(|planned| planned.node == node)
            .ok_or_else(|| ParameterError::UnknownNode {
                node: node.to_owned(),
                known: self
                    .blocks
                    .iter()
                    .map(|planned| planned.node.as_str())
                    .collect::<Vec<_>>()
                    .join(", "),
            })?;
        let bytes = bytemuck::bytes_of(parameters);
        if bytes.len() != planned.size as usize {
            return Err(ParameterError::Size {
                node: node.to_owned(),
                name: planned.name.clone(),
                expected: planned.size,
                given: bytes.len(),
            });
        }
        if layer >= planned.count {
            return Err(ParameterError::Layer {
                node: node.to_owned(),
                count: planned.count,
                layer,
            });
        }
        let given = block.len();
        let start = (planned.offset + layer * planned.stride) as usize;
        block
            .get_mut(start..start + bytes.len())
            .ok_or(ParameterError::Block {
                expected: self.size,
                given,
            })?
            .copy_from_slice(bytes);
        Ok(())
    }
}

impl Plan {
    /// Bytes of everything that the plan creates.
    #[must_use]
    pub fn bytes_resident(&self) -> u64 {
        self.memory.iter().map(|memory| memory.desc.bytes()).sum()
    }

    /// Bytes that all passes read and write when every layer is dirty.
    #[must_use]
    pub fn bytes_moved(&self) -> u64 {
        self.passes
            .iter()
            .map(|pass| pass.bytes_read + pass.bytes_written)
            .sum()
    }

    /// The description of the texture behind an output.
    #[must_use]
    pub fn output_texture(&self, name: &str) -> Option<&TextureDesc> {
        let output = self.outputs.iter().find(|output| output.name == name)?;
        self.resources.get(output.resource)?.desc.texture()
    }
}

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "imports")?;
        for import in &self.imports {
            writeln!(
                f,
                "  {:<28} {}",
                import.name, self.resources[import.resource].desc
            )?;
        }
        for stage in Stage::ALL {
            writeln!(f, "stage {stage:?}")?;
            for pass in self.passes.iter().filter(|pass| pass.stage == stage) {
                let work = match &pass.work {
                    PlannedWork::Compute { workgroups } => {
                        format!("compute {}x{} workgroups", workgroups[0], workgroups[1])
                    }
                    PlannedWork::Fullscreen { target } => {
                        format!("fullscreen to {}", self.resources[*target].name)
                    }
                    PlannedWork::Host { .. } => "the host draws".to_owned(),
                };
                let layers = if pass.each_layer {
                    format!(" x {} layers", pass.layers)
                } else {
                    String::new()
                };
                writeln!(
                    f,
                    "  {:<28} {work}{layers}, {} read, {} written",
                    format!("{}/{}", pass.node, pass.label),
                    Bytes(pass.bytes_read),
                    Bytes(pass.bytes_written)
                )?;
            }
        }
        writeln!(f, "memory ({} resident)", Bytes(self.bytes_resident()))?;
        for memory in &self.memory {
            writeln!(
                f,
                "  {:<28} {}, {}",
                memory.label,
                memory.desc,
                Bytes(memory.desc.bytes())
            )?;
        }
        writeln!(f, "parameters ({} bytes per view)", self.parameters.size)?;
        for block in &self.parameters.blocks {
            writeln!(
                f,
                "  {:<28} {} at {}, {} bytes x {}",
                block.node, block.name, block.offset, block.size, block.count
            )?;
        }
        writeln!(f, "outputs")?;
        for output in &self.outputs {
            writeln!(
                f,
                "  {:<28} {}",
                output.name, self.resources[output.resource].name
            )?;
        }
        Ok(())
    }
}

/// A number of bytes, readable.
struct Bytes(u64);

impl fmt::Display for Bytes {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            bytes @ 0..=9999 => write!(f, "{bytes} B"),
            bytes => write!(f, "{:.2} MiB", bytes as f64 / f64::from(1 << 20)),
        }
    }
}
