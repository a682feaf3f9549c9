//! A compiled graph: passes in order, resources, memory and parameters, as data that any host can record.

mod access;
mod check;
mod parameters;
mod regions;
mod text;

use std::collections::BTreeMap;

pub(crate) use access::Part;
pub use parameters::{ParameterLayout, PlannedParameters};
pub use regions::PlannedRegions;
use serde::{Deserialize, Serialize};

use crate::{Access, Binding, Named, ResourceDesc, Stage, TextureDesc};

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
    /// What the host gives, in the order of the graph file; only what a pass touches. Values are indices into `resources`.
    pub imports: Vec<Named<usize>>,
    /// What the host takes; values are indices into `resources`.
    pub outputs: Vec<Named<usize>>,
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
    /// What the bindings hold, by their numbers.
    pub bindings: Vec<Binding<u32, PlannedBindingResource>>,
    /// What is recorded.
    pub work: PlannedWork,
    /// How often it is recorded when every layer is dirty.
    pub layers: u32,
    /// Whether it is recorded once per dirty layer; otherwise once per stage.
    pub each_layer: bool,
    /// The import or resource whose layers (and regions) it follows: the one that a host names to say which are dirty.
    pub map: String,
    /// Bytes read when every layer is dirty, each texel once.
    pub bytes_read: u64,
    /// Bytes written when every layer is dirty.
    pub bytes_written: u64,
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
    /// The regions of the layer that the pass is recorded for, in the same buffer, with a dynamic offset of their own.
    Regions {
        /// Index into the region tables of [`Plan::parameters`].
        table: usize,
        /// Bytes.
        size: u32,
    },
    /// A texture that is loaded or sampled.
    Texture {
        /// Index into [`Plan::resources`].
        resource: usize,
        /// A view of one layer, the one that the pass is recorded for; otherwise an array view of all.
        one_layer: bool,
        /// The one mip level of a view of one layer; an array view has all.
        level: u32,
        /// The plane of a view of one layer: it shows texture layer `layer x planes + plane`.
        #[serde(default)]
        plane: u32,
        /// What a load gives.
        sample: SampleType,
        /// Whether texels have several samples.
        multisampled: bool,
    },
    /// One mip level of one layer of a texture that is written.
    StorageTexture {
        /// Index into [`Plan::resources`].
        resource: usize,
        /// The mip level.
        level: u32,
        /// The plane, as above.
        #[serde(default)]
        plane: u32,
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
        /// The most probes of an anisotropic lookup, 1 to 16.
        anisotropy: u16,
    },
    /// A comparison sampler that clamps to the edge and filters linearly.
    ComparisonSampler {
        /// Passes references that are less than the texel; otherwise those that are greater.
        reversed: bool,
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
    /// Unsigned integers, loaded only.
    Integer,
}

/// What a pass records.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PlannedWork {
    /// A dispatch, of as many workgroups as cover a texture or all its regions.
    Compute {
        /// Workgroups in x and y.
        workgroups: [u32; 2],
    },
    /// A triangle over the whole of a mip level of a target.
    Fullscreen {
        /// Index into [`Plan::resources`].
        target: usize,
        /// The mip level.
        #[serde(default)]
        level: u32,
        /// The plane, as of [`PlannedBindingResource::Texture`].
        #[serde(default)]
        plane: u32,
        /// Whether the target keeps its contents where the shader discards; otherwise it is drawn whole.
        #[serde(default)]
        keeps: bool,
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
    /// The description of the texture or buffer.
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
    /// The description of the texture or buffer.
    pub desc: ResourceDesc,
    /// The access that it has to allow.
    pub access: Access,
    /// Whether the host takes it as an output, and may copy from it.
    pub exported: bool,
}

impl PlannedPass {
    /// `node/pass`, by which hosts name a pass.
    #[must_use]
    pub fn name(&self) -> String {
        format!("{}/{}", self.node, self.label)
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
        self.resources.get(output.value)?.desc.texture()
    }
}
