//! A node's resources, and the rules for what they are.

use moment_shadows::{Finite, MapEncoding, TextureFormat};
use serde::{Deserialize, Serialize};

use crate::Access;

/// A named resource of a node.
#[must_use]
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Slot {
    /// The name, unique within the node.
    pub name: String,
    /// What the slot is for: a sentence.
    pub description: String,
    /// Whether edges lead in, out, both or nowhere.
    pub direction: Direction,
    /// Whether the contents are kept from frame to frame, in memory of their own. Otherwise they matter until the last
    /// reader in the frame, and the memory may then serve another resource.
    pub persistent: bool,
    /// Whether the node can do without it. Only inputs are optional.
    pub optional: bool,
    /// What the slot carries.
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

impl Direction {
    /// Whether an edge leads in.
    pub(crate) fn takes(self) -> bool {
        matches!(self, Direction::In | Direction::InOut)
    }
}

/// What a slot holds.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(
    clippy::large_enum_variant,
    reason = "a description has a handful of slots, nearly all of them textures"
)]
pub enum SlotResource {
    /// A texture.
    Texture(TextureRule),
    /// A storage buffer.
    Buffer {
        /// How the node's passes touch it.
        access: Access,
        /// Bytes; for inputs, at least.
        size: u64,
    },
}

/// What a texture may be, or what it becomes.
#[must_use]
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TextureRule {
    /// How the node's passes touch it.
    pub access: Access,
    /// The format. The format of another slot comes with its planes and encoding.
    pub format: Rule<TextureFormat>,
    /// What the texels of a filterable map mean that the node makes; its format and planes follow.
    pub encoding: Option<Box<MapEncoding>>,
    /// Width and height. Those of another slot come with its regions.
    pub extent: Rule<[u32; 2]>,
    /// Texels of that other slot for each texel, rounded up; the regions come along only where these are one.
    #[serde(default = "one_each")]
    pub per: [u32; 2],
    /// Number of layers.
    pub layers: Rule<u32>,
    /// Number of mip levels.
    pub mips: Rule<u32>,
    /// Samples per texel.
    pub samples: Rule<u32>,
    /// The standard deviation of the node's filter, along either axis, in texels. It adds to that of the map whose format
    /// the texture takes; 0 where the node does not filter.
    #[serde(default)]
    pub deviation: Finite,
    /// The same in scene units, where each region has a kernel of its own.
    #[serde(default)]
    pub width: Finite,
    /// The slot whose range the map's depths are fitted to, where that is connected; ranges name their own slot. A texture that
    /// takes the format of another slot takes its range, too.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fitted_to: Option<String>,
}

fn one_each() -> [u32; 2] {
    [1; 2]
}

/// What a property of a texture may be, or what it becomes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rule<T> {
    /// This value.
    Exact(T),
    /// One of these values. Only for inputs.
    OneOf(Vec<T>),
    /// Any value. Only for inputs.
    Any,
    /// What another slot has.
    SameAs(String),
}

impl<T> Rule<T> {
    /// What another slot has.
    pub fn same_as(slot: &str) -> Self {
        Rule::SameAs(slot.to_owned())
    }
}

impl<T> From<T> for Rule<T> {
    fn from(value: T) -> Self {
        Rule::Exact(value)
    }
}

impl<T> From<Vec<T>> for Rule<T> {
    fn from(values: Vec<T>) -> Self {
        Rule::OneOf(values)
    }
}

impl Slot {
    fn new(
        direction: Direction,
        name: &str,
        description: &str,
        resource: impl Into<SlotResource>,
    ) -> Self {
        Self {
            name: name.to_owned(),
            description: description.to_owned(),
            direction,
            persistent: false,
            optional: false,
            resource: resource.into(),
        }
    }

    /// What an edge has to lead to.
    pub fn input(name: &str, description: &str, resource: impl Into<SlotResource>) -> Self {
        Self::new(Direction::In, name, description, resource)
    }

    /// What the node makes.
    pub fn output(name: &str, description: &str, resource: impl Into<SlotResource>) -> Self {
        Self::new(Direction::Out, name, description, resource)
    }

    /// What an edge leads to, and the node changes in place.
    pub fn in_out(name: &str, description: &str, resource: impl Into<SlotResource>) -> Self {
        Self::new(Direction::InOut, name, description, resource)
    }

    /// What the node needs for itself.
    pub fn internal(name: &str, description: &str, resource: impl Into<SlotResource>) -> Self {
        Self::new(Direction::Internal, name, description, resource)
    }

    /// An input that the node can do without.
    pub fn optional(mut self) -> Self {
        self.optional = true;
        self
    }

    /// Contents that are kept from frame to frame.
    pub fn persistent(mut self) -> Self {
        self.persistent = true;
        self
    }
}

impl SlotResource {
    /// How the node's passes touch it.
    pub fn access(&self) -> Access {
        match self {
            SlotResource::Texture(TextureRule { access, .. })
            | SlotResource::Buffer { access, .. } => *access,
        }
    }
}

impl From<TextureRule> for SlotResource {
    fn from(rule: TextureRule) -> Self {
        SlotResource::Texture(rule)
    }
}

/// Texture rules, from the common case on: one layer, one mip level and one sample per texel, of any size.
impl TextureRule {
    /// A texture of a format, of one of several, or of that of another slot ([`Rule::same_as`]).
    pub fn new(format: impl Into<Rule<TextureFormat>>) -> Self {
        Self {
            // A description's passes say it.
            access: Access::default(),
            format: format.into(),
            encoding: None,
            extent: Rule::Any,
            per: one_each(),
            layers: Rule::Exact(1),
            mips: Rule::Exact(1),
            samples: Rule::Exact(1),
            deviation: Finite::ZERO,
            width: Finite::ZERO,
            fitted_to: None,
        }
    }

    /// A filterable map that the node makes.
    pub fn of_map(encoding: MapEncoding) -> Self {
        let rule = Self::new(encoding.format());
        Self {
            encoding: Some(Box::new(encoding)),
            ..rule
        }
    }

    /// Touched so, too. What a description's own passes do need not be said.
    pub fn access(mut self, access: Access) -> Self {
        self.access = self.access.union(access);
        self
    }

    /// Width and height, or those of another slot, whose regions it then has, too.
    pub fn extent(mut self, extent: impl Into<Rule<[u32; 2]>>) -> Self {
        self.extent = extent.into();
        self
    }

    /// One texel for so many of another slot, rounded up, in as many layers.
    pub fn tiles_of(self, slot: &str, per: [u32; 2]) -> Self {
        Self {
            per,
            ..self.like(slot)
        }
    }

    /// The size, regions and layers of another slot.
    pub fn like(self, slot: &str) -> Self {
        self.extent(Rule::same_as(slot)).layers(Rule::same_as(slot))
    }

    /// How many layers.
    pub fn layers(mut self, layers: impl Into<Rule<u32>>) -> Self {
        self.layers = layers.into();
        self
    }

    /// How many mip levels.
    pub fn mips(mut self, mips: impl Into<Rule<u32>>) -> Self {
        self.mips = mips.into();
        self
    }

    /// Filtered by a kernel of this standard deviation along either axis, in texels.
    pub fn filtered(mut self, deviation: Finite) -> Self {
        self.deviation = deviation;
        self
    }

    /// Filtered in each region by a kernel of this standard deviation along either axis, in scene units.
    pub fn filtered_in_scene(mut self, width: Finite) -> Self {
        self.width = width;
        self
    }

    /// With depths that are fitted to the range of a slot, where that is connected; for ranges their own slot.
    pub fn fitted_to(mut self, slot: &str) -> Self {
        self.fitted_to = Some(slot.to_owned());
        self
    }

    /// Width and height that follow from those of another slot.
    pub(crate) fn extent_of(&self, size: [u32; 2]) -> [u32; 2] {
        [0, 1].map(|axis| size[axis].div_ceil(self.per[axis].max(1)))
    }

    /// How many samples per texel.
    pub fn samples(mut self, samples: impl Into<Rule<u32>>) -> Self {
        self.samples = samples.into();
        self
    }
}
