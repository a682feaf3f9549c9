//! Concrete resources, as imports, slots and plans describe them.

use core::fmt;

use moment_shadows::{Finite, MapEncoding, TextureFormat};
use serde::{Deserialize, Serialize};

/// A texture.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct TextureDesc {
    /// The format.
    pub format: TextureFormat,
    /// Width and height in texels.
    pub size: [u32; 2],
    /// Number of layers.
    #[serde(default = "one")]
    pub layers: u32,
    /// Number of mip levels.
    #[serde(default = "one")]
    pub mips: u32,
    /// Regions that each layer can have: rectangles of an atlas, which change per frame. One, unless the host says
    /// otherwise, is the whole layer.
    #[serde(default = "one")]
    pub regions: u32,
    /// Texture layers that each layer of a map consists of, for techniques with more than four channels.
    #[serde(default = "one")]
    pub planes: u32,
    /// What the texels of a filterable map mean. A map without it holds four moments.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub encoding: Option<MapEncoding>,
    /// The standard deviation of the filter that a map has been through, along either axis, in texels: 0 for a map that was
    /// not blurred. The receiver bias follows from it.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub deviation: Finite,
    /// The same of the filter whose width is given in scene units, with a kernel for each region: 0 for a map without one.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub width: Finite,
    /// What the depths of a map are fitted to: the output of a node that gives the range, as `node.slot`, which itself carries the
    /// same name. None where they are those of the host's range.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub range: Option<String>,
    /// Samples per texel. A multisampled texture with several layers is a list of textures, one per layer.
    #[serde(default = "one")]
    pub samples: u32,
}

fn one() -> u32 {
    1
}

fn is_zero(value: &Finite) -> bool {
    *value == Finite::ZERO
}

impl TextureDesc {
    /// A texture with one layer, one mip level and one sample per texel.
    #[must_use]
    pub fn new(format: TextureFormat, size: [u32; 2]) -> Self {
        Self {
            format,
            size,
            layers: 1,
            mips: 1,
            regions: 1,
            planes: 1,
            encoding: None,
            deviation: Finite::ZERO,
            width: Finite::ZERO,
            range: None,
            samples: 1,
        }
    }

    /// A filterable map with one layer and one mip level.
    #[must_use]
    pub fn of_map(encoding: MapEncoding, size: [u32; 2]) -> Self {
        Self {
            planes: encoding.planes(),
            encoding: Some(encoding.clone()),
            ..Self::new(encoding.format(), size)
        }
    }

    /// Layers of the texture: all planes of all layers of the map. Plane p of layer l is texture layer l x planes + p.
    #[must_use]
    pub fn array_layers(&self) -> u32 {
        self.layers.saturating_mul(self.planes)
    }

    /// Width and height of a mip level.
    #[must_use]
    pub fn size_at(&self, level: u32) -> [u32; 2] {
        self.size.map(|side| (side >> level.min(31)).max(1))
    }

    /// Bytes of one mip level of one plane of a layer, all samples. A description from elsewhere may say what no number holds: the
    /// largest one then.
    #[must_use]
    pub fn bytes_per_level(&self, level: u32) -> u64 {
        let [width, height] = self.size_at(level).map(u64::from);
        let bytes = u64::from(self.format.bytes_per_texel());
        (width * height)
            .saturating_mul(bytes)
            .saturating_mul(u64::from(self.samples))
    }

    /// The number of mip levels of a map whose shorter side has at least one texel on each of them.
    #[must_use]
    pub fn most_levels(size: [u32; 2]) -> u32 {
        size[0].min(size[1]).max(1).ilog2() + 1
    }

    /// Bytes of all layers, with all planes, mip levels and samples.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        // From this level on nothing gets smaller, however many a description from elsewhere has.
        let last = self.mips.min(31);
        let levels = (0..last).map(|level| self.bytes_per_level(level));
        let rest = u64::from(self.mips - last).saturating_mul(self.bytes_per_level(last));
        levels
            .fold(rest, u64::saturating_add)
            .saturating_mul(u64::from(self.planes))
            .saturating_mul(u64::from(self.layers))
    }
}

impl fmt::Display for TextureDesc {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}x{}", self.format, self.size[0], self.size[1])?;
        let counts = [
            (" x", self.layers, "layers"),
            (" of", self.planes, "planes"),
            (",", self.mips, "mips"),
            (",", self.regions, "regions"),
            (",", self.samples, "samples"),
        ];
        let mut several = counts.into_iter().filter(|(_, count, _)| *count > 1);
        several.try_for_each(|(joined, count, what)| write!(f, "{joined} {count} {what}"))
    }
}

/// A texture or a buffer.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum ResourceDesc {
    /// A texture.
    Texture(TextureDesc),
    /// A storage buffer of a size in bytes.
    Buffer {
        /// Bytes.
        size: u64,
    },
}

impl ResourceDesc {
    /// The texture, if it is one.
    #[must_use]
    pub fn texture(&self) -> Option<&TextureDesc> {
        match self {
            ResourceDesc::Texture(texture) => Some(texture),
            ResourceDesc::Buffer { .. } => None,
        }
    }

    /// What a device knows of it, whatever its texels mean.
    pub(crate) fn on_device(&self) -> Self {
        match self {
            Self::Texture(texture) => Self::Texture(TextureDesc {
                layers: texture.layers,
                planes: texture.planes,
                mips: texture.mips,
                samples: texture.samples,
                ..TextureDesc::new(texture.format, texture.size)
            }),
            Self::Buffer { size } => Self::Buffer { size: *size },
        }
    }

    /// Layers of a texture; a buffer has one.
    #[must_use]
    pub fn layers(&self) -> u32 {
        self.texture().map_or(1, |texture| texture.layers)
    }

    /// Bytes in memory.
    #[must_use]
    pub fn bytes(&self) -> u64 {
        match self {
            ResourceDesc::Texture(texture) => texture.bytes(),
            ResourceDesc::Buffer { size } => *size,
        }
    }
}

impl fmt::Display for ResourceDesc {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ResourceDesc::Texture(texture) => texture.fmt(f),
            ResourceDesc::Buffer { size } => write!(f, "buffer of {size} bytes"),
        }
    }
}

/// How passes touch a resource.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct Access {
    /// Loaded or sampled from; for buffers, read.
    #[serde(default)]
    pub read: bool,
    /// Written as a storage texture or a storage buffer.
    #[serde(default)]
    pub storage_write: bool,
    /// Drawn to.
    #[serde(default)]
    pub render_target: bool,
}

impl Access {
    const NONE: Access = Access {
        read: false,
        storage_write: false,
        render_target: false,
    };
    /// Loaded or sampled from.
    pub const READ: Access = Access {
        read: true,
        ..Access::NONE
    };
    /// Written as a storage texture or a storage buffer.
    pub const STORAGE_WRITE: Access = Access {
        storage_write: true,
        ..Access::NONE
    };
    /// Drawn to.
    pub const RENDER_TARGET: Access = Access {
        render_target: true,
        ..Access::NONE
    };

    /// Both accesses together.
    #[must_use]
    pub fn union(self, other: Access) -> Access {
        Access {
            read: self.read || other.read,
            storage_write: self.storage_write || other.storage_write,
            render_target: self.render_target || other.render_target,
        }
    }

    /// Whether everything in `other` is in `self`.
    #[must_use]
    pub fn contains(self, other: Access) -> bool {
        self.union(other) == self
    }

    /// Whether it changes the resource.
    #[must_use]
    pub fn writes(self) -> bool {
        self.storage_write || self.render_target
    }
}
