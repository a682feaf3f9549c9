//! The contract: a node describes itself, as plain data, to any engine.

use std::collections::BTreeMap;

use moment_shadows::{MapEncoding, TextureFormat};
use serde::{Deserialize, Serialize};

use crate::{Access, Capabilities, GraphError, GraphErrorKind, ResourceDesc, TextureDesc};

/// When a pass is recorded. A host interleaves its own work with the stages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Stage {
    /// After the host has drawn its shadow maps.
    AfterShadowMaps,
    /// After the host's main pass: the camera's depth is known.
    AfterMainPass,
}

impl Stage {
    /// Every stage, in order.
    pub const ALL: [Stage; 2] = [Stage::AfterShadowMaps, Stage::AfterMainPass];
}

/// What a node is: all that an engine needs to give it resources and to record it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NodeDesc {
    /// The node type's name.
    pub name: String,
    /// When its passes are recorded.
    pub stage: Stage,
    /// The resources it is connected to others by, and those it needs for itself.
    pub slots: Vec<Slot>,
    /// Its passes, in order.
    pub passes: Vec<Pass>,
    /// The uniform data it is given, if any.
    pub parameters: Option<ParameterBlock>,
}

/// A named resource of a node.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Slot {
    /// The name, unique within the node.
    pub name: String,
    /// Whether edges lead in, out, both or nowhere.
    pub direction: Direction,
    /// How long the contents matter.
    pub lifetime: Lifetime,
    /// Whether the node can do without it. Only inputs are optional.
    pub optional: bool,
    /// What it is.
    pub resource: SlotResource,
}

/// Where a slot's edges lead.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Direction {
    /// Read by the node.
    In,
    /// Made by the node.
    Out,
    /// Read and changed in place: an edge leads in, and others may lead out.
    InOut,
    /// Used by the node alone.
    Internal,
}

/// How long a resource's contents matter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Lifetime {
    /// Until its last reader in the frame; its memory may then serve another resource.
    Frame,
    /// Until the resources are dropped; its memory is its own.
    Persistent,
}

/// What a slot holds.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SlotResource {
    /// A texture.
    Texture {
        /// How the node's passes touch it.
        access: Access,
        /// The format.
        format: FormatRule,
        /// Width and height.
        extent: ExtentRule,
        /// Number of layers.
        layers: CountRule,
        /// Number of mip levels.
        mips: CountRule,
        /// Samples per texel.
        samples: CountRule,
    },
    /// A storage buffer.
    Buffer {
        /// How the node's passes touch it.
        access: Access,
        /// Bytes; for inputs, at least.
        size: u64,
    },
}

/// Which format a texture has.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FormatRule {
    /// This one.
    Exact(TextureFormat),
    /// That of a filterable map with this encoding, which the texture then has.
    Encoded(MapEncoding),
    /// One of these. Only for inputs.
    OneOf(Vec<TextureFormat>),
    /// That of another slot, with its planes and encoding.
    SameAs(String),
}

/// Which width and height a texture has. A texture that takes those of another slot also has its regions.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ExtentRule {
    /// These.
    Exact([u32; 2]),
    /// Any. Only for inputs.
    Any,
    /// Those of another slot.
    SameAs(String),
}

/// How many layers, mip levels or samples a texture has.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CountRule {
    /// This many.
    Exact(u32),
    /// One of these. Only for inputs.
    OneOf(Vec<u32>),
    /// Any. Only for inputs.
    Any,
    /// As many as another slot.
    SameAs(String),
}

/// One dispatch or draw per layer (or per frame).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pass {
    /// The name, unique within the node.
    pub label: String,
    /// Linked WGSL; empty for a host's pass.
    pub wgsl: String,
    /// The compute or fragment entry point. A fullscreen pass also has a vertex entry point named `fullscreen`.
    pub entry_point: String,
    /// What the shader's bindings hold.
    pub bindings: Vec<Binding>,
    /// Values of the shader's `override` constants.
    pub constants: BTreeMap<String, f64>,
    /// The plane that bindings of a single layer mean, where a map has several.
    #[serde(default)]
    pub plane: u32,
    /// What is recorded.
    pub work: Work,
}

/// What a binding of the plan's bind group holds.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Binding {
    /// The binding's index.
    pub binding: u32,
    /// What it holds.
    pub resource: BindingResource,
}

/// What a binding holds.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum BindingResource {
    /// The node's uniform data.
    Parameters,
    /// The regions of a slot's map in the layer that the pass is recorded for: a uniform array of `MapRegion`, which all
    /// nodes share that work on maps with those regions.
    Regions(RegionTable),
    /// One layer of a texture, mip level 0, loaded or sampled: the layer that the pass is recorded for.
    Layer(String),
    /// The same of another mip level.
    Level(MipLevel),
    /// All layers of a texture, with all their planes, loaded or sampled.
    Layers(String),
    /// One layer of a texture, mip level 0, written.
    StorageLayer(String),
    /// The same of another mip level.
    StorageLevel(MipLevel),
    /// A storage buffer.
    Buffer(String),
    /// A sampler that clamps to the edge.
    Sampler {
        /// Linear within and between mip levels; otherwise nearest.
        filtering: bool,
        /// The most probes of an anisotropic lookup, 1 to 16. More than one needs `filtering`.
        anisotropy: u16,
    },
    /// A comparison sampler that clamps to the edge and filters linearly.
    ComparisonSampler {
        /// Passes references that are less than the texel, for maps that store 1 at the near plane; otherwise those that are
        /// greater.
        reversed: bool,
    },
}

/// A mip level of a slot's texture.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MipLevel {
    /// The slot.
    pub slot: String,
    /// The mip level.
    pub level: u32,
}

/// The regions of a slot's map, and what a pass asks of them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RegionTable {
    /// The slot.
    pub slot: String,
    /// The fewest texels that a region can have along each side.
    pub smallest: u32,
}

/// What a pass records.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Work {
    /// A dispatch that covers a texture, or one of a single workgroup column for a buffer.
    Compute {
        /// The slot that is covered.
        covers: String,
        /// Texels that one workgroup covers.
        texels_per_workgroup: [u32; 2],
        /// Once per dirty layer of `covers`; otherwise once.
        each_layer: bool,
    },
    /// A dispatch that covers the regions of one layer, once per dirty layer. Where a layer can have one region,
    /// workgroups lie in a grid from its origin on. Where it can have more, they are numbered through the regions, row by
    /// row of each; there are enough of them for any regions that do not overlap.
    ComputeRegions {
        /// The slot that is covered.
        covers: String,
        /// The mip level that is covered.
        level: u32,
        /// Texels that one workgroup covers.
        texels_per_workgroup: [u32; 2],
    },
    /// A triangle over the whole of a target, which need not be cleared.
    Fullscreen {
        /// The slot that is drawn to; of a map with planes the pass's plane.
        target: String,
        /// Once per dirty layer of the target; otherwise once, to layer 0.
        each_layer: bool,
    },
    /// A triangle over the whole of a mip level of one layer, once per dirty layer, whose shader discards what lies in no
    /// region: as with [`ComputeRegions`](Work::ComputeRegions) the target keeps its contents there.
    FullscreenRegions {
        /// The slot that is drawn to; of a map with planes the pass's plane.
        target: String,
        /// The mip level that is drawn to.
        level: u32,
    },
    /// A hole in the plan where the host draws.
    Host {
        /// The colour targets.
        targets: Vec<String>,
        /// Whether the host blends into them.
        blend: bool,
        /// The depth target.
        depth: Option<String>,
    },
}

/// Uniform data that a host fills in for each view.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct ParameterBlock {
    /// The WGSL struct's name.
    pub name: String,
    /// The struct's size in bytes.
    pub size: u32,
    /// How many structs a binding holds: more than one are a uniform array.
    pub elements: u32,
    /// Whether there is one struct (or array) per layer of this slot; otherwise one.
    pub each_layer_of: Option<String>,
    /// What each struct holds until the host writes something else; zeros where empty.
    pub initial: Vec<u8>,
}

/// What is connected to a node's inputs, and what the device offers.
#[derive(Clone, Copy, Debug)]
pub struct Connected<'a> {
    pub(crate) inputs: &'a BTreeMap<String, ResourceDesc>,
    pub(crate) capabilities: &'a Capabilities,
}

impl<'a> Connected<'a> {
    /// Connections by slot name.
    #[must_use]
    pub fn new(inputs: &'a BTreeMap<String, ResourceDesc>, capabilities: &'a Capabilities) -> Self {
        Self {
            inputs,
            capabilities,
        }
    }

    /// What the device offers.
    #[must_use]
    pub fn capabilities(&self) -> &'a Capabilities {
        self.capabilities
    }

    /// What is connected to a slot, if anything.
    #[must_use]
    pub fn get(&self, slot: &str) -> Option<&'a ResourceDesc> {
        self.inputs.get(slot)
    }

    /// The texture that is connected to a required slot.
    pub fn texture(&self, slot: &str) -> Result<&'a TextureDesc, GraphError> {
        let resource = self.inputs.get(slot).ok_or_else(|| {
            GraphError::new(
                GraphErrorKind::MissingInput,
                "nothing is connected to this input; add an edge that leads to it",
            )
            .at_slot(slot)
        })?;
        resource.texture().ok_or_else(|| {
            GraphError::new(
                GraphErrorKind::Format,
                "a buffer is connected, but this input takes a texture",
            )
            .at_slot(slot)
        })
    }
}

/// A node type with its properties.
///
/// `describe` is pure and repeatable: it creates nothing and gives the same answer for the same connections.
pub trait Node: core::fmt::Debug + Send + Sync {
    /// The node for what its inputs are connected to.
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError>;
}
