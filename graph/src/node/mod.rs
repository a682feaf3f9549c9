//! The contract: a node describes itself, as plain data, to any engine.

pub mod bind;
mod pass;
mod slot;

use std::collections::BTreeMap;

pub use pass::{Binding, BindingResource, ParameterBlock, Pass, Work};
use serde::{Deserialize, Serialize};
pub use slot::{Direction, Rule, Slot, SlotResource, TextureRule};

use crate::{Capabilities, GraphError, GraphErrorKind, ResourceDesc, TextureDesc};

/// When a pass is recorded. A host interleaves its own work with the stages.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
#[must_use]
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
    /// What stands in for outputs, by their names, where a host leaves the node out.
    #[serde(default)]
    pub off: BTreeMap<String, Off>,
}

/// What stands in for an output of a node that is left out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Off {
    /// This input: readers of the output take that. Both are the same kind of texture.
    Bypass(String),
    /// A texture that holds this texel everywhere, one for each plane: channels, or whole numbers where the format has integers.
    Fill(Vec<[f64; 4]>),
}

/// A description, piece by piece. How passes touch slots is added to the slots' access, in whatever order both come.
impl NodeDesc {
    /// A node without slots and passes.
    pub fn new(name: &str, stage: Stage) -> Self {
        Self {
            name: name.to_owned(),
            stage,
            slots: Vec::new(),
            passes: Vec::new(),
            parameters: None,
            off: BTreeMap::new(),
        }
    }

    /// Adds a slot, or as many as there are.
    pub fn slots(mut self, slots: impl IntoIterator<Item = Slot>) -> Self {
        self.slots.extend(slots);
        self.with_access()
    }

    /// Adds an input.
    pub fn input(self, name: &str, description: &str, resource: impl Into<SlotResource>) -> Self {
        self.slots([Slot::input(name, description, resource)])
    }

    /// Adds an output.
    pub fn output(self, name: &str, description: &str, resource: impl Into<SlotResource>) -> Self {
        self.slots([Slot::output(name, description, resource)])
    }

    /// Adds a resource of the node's own.
    pub fn internal(
        self,
        name: &str,
        description: &str,
        resource: impl Into<SlotResource>,
    ) -> Self {
        self.slots([Slot::internal(name, description, resource)])
    }

    /// Adds a pass.
    pub fn pass(self, pass: Pass) -> Self {
        self.passes([pass])
    }

    /// Adds passes, in order.
    pub fn passes(mut self, passes: impl IntoIterator<Item = Pass>) -> Self {
        self.passes.extend(passes);
        self.with_access()
    }

    /// Gives the node uniform data.
    pub fn parameters(mut self, block: ParameterBlock) -> Self {
        self.parameters = Some(block);
        self
    }

    /// What stands in for an output where the node is left out.
    pub fn off(mut self, output: &str, off: Off) -> Self {
        self.off.insert(output.to_owned(), off);
        self
    }

    /// Slots may be touched in every way in which a pass does.
    fn with_access(mut self) -> Self {
        for (name, access) in self.passes.iter().flat_map(Pass::touched) {
            let slot = self.slots.iter_mut().find(|slot| slot.name == name);
            if let Some(SlotResource::Texture(rule)) = slot.map(|slot| &mut slot.resource) {
                rule.access = rule.access.union(access);
            }
        }
        self
    }
}

/// What is connected to a node's inputs, and what the device offers.
#[derive(Clone, Copy, Debug)]
pub struct Connected<'a> {
    pub(crate) inputs: &'a BTreeMap<String, ResourceDesc>,
    pub(crate) capabilities: &'a Capabilities,
}

impl<'a> Connected<'a> {
    /// Connections by slot name.
    pub fn new(inputs: &'a BTreeMap<String, ResourceDesc>, capabilities: &'a Capabilities) -> Self {
        Self {
            inputs,
            capabilities,
        }
    }

    /// What the device offers.
    pub fn capabilities(&self) -> &'a Capabilities {
        self.capabilities
    }

    /// What is connected to a slot, if anything.
    pub fn get(&self, slot: &str) -> Option<&'a ResourceDesc> {
        self.inputs.get(slot)
    }

    /// The texture that is connected to a required slot.
    pub fn texture(&self, slot: &str) -> Result<&'a TextureDesc, GraphError> {
        let resource = self.get(slot).ok_or_else(|| missing_input(slot))?;
        let texture = resource.texture();
        texture.ok_or_else(|| wrong_kind("buffer", "texture").at_slot(slot))
    }
}

/// The error about a texture where a buffer is needed, or the other way round.
pub(crate) fn wrong_kind(connected: &str, taken: &str) -> GraphError {
    let message = format!("a {connected} is connected, but this input takes a {taken}");
    GraphError::new(GraphErrorKind::Format, message)
}

/// The error about a required input.
pub(crate) fn missing_input(slot: &str) -> GraphError {
    GraphError::new(
        GraphErrorKind::MissingInput,
        "nothing is connected to this input; add an edge that leads to it",
    )
    .at_slot(slot)
}

/// A node type with its properties.
///
/// `describe` is pure and repeatable: it creates nothing and gives the same answer for the same connections.
pub trait Node: core::fmt::Debug + Send + Sync {
    /// The node for what its inputs are connected to.
    fn describe(&self, upstream: &Connected<'_>) -> Result<NodeDesc, GraphError>;
}
