//! A compiled graph: passes in order, resources, memory and parameters, as data that any host can record.

mod access;
mod check;
mod compact;
mod hazards;
mod layout;
mod parameters;
mod regions;
mod text;

use std::collections::BTreeMap;

pub(crate) use access::{MOST_TARGETS, Part};
pub use hazards::PlannedUse;
pub use layout::{
    AddressMode, BindingLayout, BufferKind, CompareFunction, FilterMode, PlannedSampler,
    SampleType, SamplerKind, StorageAccess, Usage, ViewDimension, Visibility,
};
pub use parameters::{ParameterLayout, PlannedField, PlannedParameters};
pub use regions::PlannedRegions;
use serde::{Deserialize, Serialize};

use crate::{Named, ResourceDesc, Stage, TextureDesc};

/// All that a host needs to record a graph, in any language: as JSON, whose schema is `graph/plan.schema.json`. Formats, usages,
/// layouts, sampler states, features and limits have WebGPU's own names.
///
/// A host that records passes in the plan's order takes [`Plan::memory`]. A frame graph that orders, allocates and shares memory by
/// itself takes [`Plan::resources`], of which nothing overwrites what is still to be read, and [`PlannedPass::after`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The version of this format.
    pub version: u32,
    /// What a device has to have.
    pub device: PlannedDevice,
    /// The index of the bind group that all passes use; lower ones are empty.
    pub bind_group: u32,
    /// The texts of the shaders, linked WGSL, each once.
    pub shaders: Vec<String>,
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
    /// What stands in for outputs of nodes whose passes a host leaves out. A node of which an output is not listed, and is read, cannot
    /// be left out alone.
    pub off: Vec<PlannedOff>,
}

/// What stands in for an output of a node that is left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlannedOff {
    /// The node's name in the graph.
    pub node: String,
    /// The output: index into [`Plan::resources`].
    pub output: usize,
    /// What passes and hosts read in its place.
    pub instead: Instead,
}

/// What is read in place of an output.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Instead {
    /// This resource: index into [`Plan::resources`].
    Bypass(usize),
    /// The output, after the host has filled all of it with this texel, one for each plane; it needs a usage for that. It stays until
    /// the node is recorded again.
    Fill(Vec<[f64; 4]>),
}

/// A pass with everything resolved.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlannedPass {
    /// The node's name in the graph.
    pub node: String,
    /// The pass's name within the node.
    pub label: String,
    /// When it is recorded.
    pub stage: Stage,
    /// Index into [`Plan::shaders`]; none for a host's pass.
    pub shader: Option<usize>,
    /// The compute or fragment entry point; empty for a host's pass.
    pub entry_point: String,
    /// The vertex entry point of a fullscreen pass: three vertices, no buffers. It takes no constants.
    pub vertex_entry_point: Option<String>,
    /// Values of `override` constants.
    pub constants: BTreeMap<String, f64>,
    /// The stage that sees the bindings; none for a host's pass.
    pub visibility: Option<Visibility>,
    /// What the bindings hold, in the order of their numbers.
    pub bindings: Vec<PlannedBinding>,
    /// The dynamic offsets, in the order of the bindings that take one.
    pub dynamic_offsets: Vec<PlannedOffset>,
    /// What is recorded.
    pub work: PlannedWork,
    /// What is read.
    pub reads: Vec<PlannedUse>,
    /// What is written.
    pub writes: Vec<PlannedUse>,
    /// The passes that this one has to follow, where every resource has memory of its own: those of which either writes what the
    /// other touches. Indices into [`Plan::passes`].
    pub after: Vec<usize>,
    /// The same where resources live in [`Plan::memory`]. There is no need of it in the plan's order.
    pub after_in_memory: Vec<usize>,
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

/// A binding of a pass.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlannedBinding {
    /// Its number.
    pub binding: u32,
    /// The WGSL variable.
    pub name: String,
    /// Its kind.
    pub layout: BindingLayout,
    /// What it holds.
    pub resource: PlannedBindingResource,
}

/// What a binding holds; `resource`, `block` and `table` are indices into the plan.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum PlannedBindingResource {
    /// The uniform data of a node, in the view's buffer.
    Parameters {
        /// Index into the blocks of [`Plan::parameters`].
        block: usize,
    },
    /// The regions of the layer that the pass is recorded for, in the same buffer.
    Regions {
        /// Index into the region tables of [`Plan::parameters`].
        table: usize,
    },
    /// A texture that is loaded or sampled. Its view shows depth alone where there is a stencil beside it.
    Texture {
        /// Index into [`Plan::resources`].
        resource: usize,
        /// A view of one mip level of one plane of the layer that the pass is recorded for; otherwise an array view of all.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        part: Option<PlannedPart>,
    },
    /// A texture that is written.
    StorageTexture {
        /// Index into [`Plan::resources`].
        resource: usize,
        /// The mip level and the plane of the layer that the pass is recorded for.
        part: PlannedPart,
    },
    /// A storage buffer.
    Buffer {
        /// Index into [`Plan::resources`].
        resource: usize,
    },
    /// A sampler.
    Sampler(PlannedSampler),
}

/// A part of the layer that a pass is recorded for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlannedPart {
    /// The mip level.
    pub level: u32,
    /// The plane: texture layer `layer x planes + plane`.
    pub plane: u32,
}

/// A dynamic offset: from the start of the view's block in the parameter buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlannedOffset {
    /// Bytes for layer 0.
    pub offset: u32,
    /// Bytes from one layer to the next; 0 where all layers have the same.
    pub stride: u32,
}

/// What a device has to have, by WebGPU's names.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlannedDevice {
    /// Features beyond core WebGPU.
    pub features: Vec<String>,
    /// Features of wgpu that WebGPU has no name for: no browser runs such a plan.
    pub wgpu_features: Vec<String>,
    /// What the plan needs of limits: the least for those that begin with `max`, the most for `minUniformBufferOffsetAlignment`.
    pub limits: BTreeMap<String, u64>,
}

/// What a pass records.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum PlannedWork {
    /// A dispatch, of as many workgroups as cover a texture or all its regions.
    Compute {
        /// Workgroups in x and y.
        workgroups: [u32; 2],
        /// What they cover: index into [`Plan::resources`].
        covers: usize,
        /// The mip level that they cover.
        level: u32,
        /// Texels of a workgroup: workgroups are the extent of the level divided by these, rounded up.
        texels_per_workgroup: [u32; 2],
        /// Where there is a number: workgroups are numbered through at most so many regions of a layer, row by row of each, and there
        /// are enough of them for any regions that do not overlap.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        regions: Option<u32>,
    },
    /// A triangle over the whole of a mip level of a target, which need not be cleared; our recorder clears it to zeros.
    Fullscreen {
        /// Index into [`Plan::resources`].
        target: usize,
        /// The mip level and the plane of the layer that the pass is recorded for.
        part: PlannedPart,
        /// Whether the target keeps its contents where the shader discards (`loadOp` is `load`); otherwise it is drawn whole.
        keeps: bool,
    },
    /// A hole where the host draws.
    Host {
        /// Colour targets, indices into [`Plan::resources`].
        targets: Vec<usize>,
        /// Planes of each colour target: all of those of the layer that the pass is recorded for are drawn to at once, one target's after
        /// the other's.
        #[serde(default = "one", skip_serializing_if = "is_one")]
        planes: u32,
        /// Whether the host blends.
        blend: bool,
        /// Depth target, index into [`Plan::resources`].
        depth: Option<usize>,
    },
}

fn one() -> u32 {
    1
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "as serde calls it")]
fn is_one(planes: &u32) -> bool {
    *planes == 1
}

/// A resource.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlannedResource {
    /// `node.slot`, or the import's name.
    pub name: String,
    /// The description of the texture or buffer.
    pub desc: ResourceDesc,
    /// The usages that passes need of it.
    pub usage: Vec<Usage>,
    /// How its width and height follow from an import; none where they do not. Of an import, those of another that it has to be as
    /// large as, or its own.
    pub extent: Option<PlannedExtent>,
    /// Until when it holds its contents.
    pub lives: Lives,
    /// Where it lives.
    pub home: Home,
}

/// The width and height of an import, each divided and rounded up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlannedExtent {
    /// Index into [`Plan::imports`].
    pub import: usize,
    /// Texels of the import for each texel.
    pub per: [u32; 2],
}

/// Until when a resource holds its contents.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Lives {
    /// Until its last reader in the frame.
    Frame,
    /// From frame to frame where layers that did not change are left out: those are not written again, and are read or taken.
    LayersLeftOut,
    /// From frame to frame: the next one reads what this one wrote.
    Always,
}

/// Where a resource lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Home {
    /// The host's: index into [`Plan::imports`].
    Import(usize),
    /// The plan's: index into [`Plan::memory`].
    Memory(usize),
}

/// A texture or buffer to create.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PlannedMemory {
    /// The names of the resources that live in it, one after the other.
    pub label: String,
    /// The description of the texture or buffer.
    pub desc: ResourceDesc,
    /// The usages that it has to allow; of an output also those by which a host takes it.
    pub usage: Vec<Usage>,
}

impl PlannedPass {
    /// `node/pass`, by which hosts name a pass.
    #[must_use]
    pub fn name(&self) -> String {
        format!("{}/{}", self.node, self.label)
    }
}

impl Plan {
    /// The version of the format: that of [`Plan::version`].
    pub const VERSION: u32 = 3;

    /// The text of a pass's shader; empty for a host's pass.
    #[must_use]
    pub fn wgsl(&self, pass: &PlannedPass) -> &str {
        let text = pass.shader.and_then(|shader| self.shaders.get(shader));
        text.map_or("", String::as_str)
    }

    /// Bytes of everything that the plan creates.
    #[must_use]
    pub fn bytes_resident(&self) -> u64 {
        let memory = self.memory.iter().map(|memory| memory.desc.bytes());
        memory.fold(0, u64::saturating_add)
    }

    /// Bytes that all passes read and write when every layer is dirty.
    #[must_use]
    pub fn bytes_moved(&self) -> u64 {
        let passes = self.passes.iter();
        passes
            .flat_map(|pass| [pass.bytes_read, pass.bytes_written])
            .fold(0, u64::saturating_add)
    }

    /// The description of the texture behind an output.
    #[must_use]
    pub fn output_texture(&self, name: &str) -> Option<&TextureDesc> {
        let output = self.outputs.iter().find(|output| output.name == name)?;
        self.resources.get(output.value)?.desc.texture()
    }
}
