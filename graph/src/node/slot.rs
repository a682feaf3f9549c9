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
    /// How long the contents matter.
    pub lifetime: Lifetime,
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
    /// The format.
    pub format: FormatRule,
    /// Width and height.
    pub extent: ExtentRule,
    /// Number of layers.
    pub layers: CountRule,
    /// Number of mip levels.
    pub mips: CountRule,
    /// Samples per texel.
    pub samples: CountRule,
    /// The standard deviation of the node's filter, along either axis, in texels. It adds to that of the map whose format
    /// the texture takes; 0 where the node does not filter.
    #[serde(default)]
    pub deviation: Finite,
}

/// Which format a texture has.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FormatRule {
    /// This format.
    Exact(TextureFormat),
    /// The format of a filterable map with this encoding, which the texture then has.
    Encoded(MapEncoding),
    /// One of these formats. Only for inputs.
    OneOf(Vec<TextureFormat>),
    /// The format of another slot, with its planes and encoding.
    SameAs(String),
}

/// Which width and height a texture has. A texture that takes those of another slot also has its regions.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ExtentRule {
    /// This width and height.
    Exact([u32; 2]),
    /// Any value. Only for inputs.
    Any,
    /// The width and height of another slot.
    SameAs(String),
}

/// How many layers, mip levels or samples a texture has.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CountRule {
    /// This number.
    Exact(u32),
    /// One of these counts. Only for inputs.
    OneOf(Vec<u32>),
    /// Any value. Only for inputs.
    Any,
    /// The number that another slot has.
    SameAs(String),
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
            lifetime: Lifetime::Frame,
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
        self.lifetime = Lifetime::Persistent;
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
    /// A texture of a format: a format, several, an encoding or [`same_as`] another slot.
    pub fn new(format: impl Into<FormatRule>) -> Self {
        Self {
            // A description's passes say it.
            access: Access::default(),
            format: format.into(),
            extent: ExtentRule::Any,
            layers: CountRule::Exact(1),
            mips: CountRule::Exact(1),
            samples: CountRule::Exact(1),
            deviation: Finite::ZERO,
        }
    }

    /// Touched so, too. What a description's own passes do need not be said.
    pub fn access(mut self, access: Access) -> Self {
        self.access = self.access.union(access);
        self
    }

    /// Width and height, or [`same_as`] another slot, whose regions it then has, too.
    pub fn extent(mut self, extent: impl Into<ExtentRule>) -> Self {
        self.extent = extent.into();
        self
    }

    /// The size, regions and layers of another slot.
    pub fn like(self, slot: &str) -> Self {
        self.extent(same_as(slot)).layers(same_as(slot))
    }

    /// How many layers.
    pub fn layers(mut self, layers: impl Into<CountRule>) -> Self {
        self.layers = layers.into();
        self
    }

    /// How many mip levels.
    pub fn mips(mut self, mips: impl Into<CountRule>) -> Self {
        self.mips = mips.into();
        self
    }

    /// Filtered by a kernel of this standard deviation along either axis, in texels.
    pub fn filtered(mut self, deviation: Finite) -> Self {
        self.deviation = deviation;
        self
    }

    /// How many samples per texel.
    pub fn samples(mut self, samples: impl Into<CountRule>) -> Self {
        self.samples = samples.into();
        self
    }
}

/// What another slot has: a rule for formats, extents and counts.
#[must_use]
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SameAs(String);

/// What another slot has: a rule for formats, extents and counts.
pub fn same_as(slot: &str) -> SameAs {
    SameAs(slot.to_owned())
}

macro_rules! rules_from {
    ($($rule:ident { $($from:ty => $variant:ident),+ })+) => {
        $(
            $(impl From<$from> for $rule {
                fn from(from: $from) -> Self {
                    $rule::$variant(from.into())
                }
            })+

            impl From<SameAs> for $rule {
                fn from(SameAs(slot): SameAs) -> Self {
                    $rule::SameAs(slot)
                }
            }
        )+
    };
}

rules_from! {
    FormatRule { TextureFormat => Exact, MapEncoding => Encoded, Vec<TextureFormat> => OneOf, &[TextureFormat] => OneOf }
    ExtentRule { [u32; 2] => Exact }
    CountRule { u32 => Exact, Vec<u32> => OneOf }
}
