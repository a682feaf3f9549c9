//! How moments lie in memory, and what each choice costs.

use core::fmt;

use serde::{Deserialize, Serialize};

use crate::constants::{
    STORAGE_FIXED32, STORAGE_FLOAT16, STORAGE_FLOAT32, STORAGE_PACKED32, STORAGE_PACKED64,
    STORAGE_UNORM8, STORAGE_UNORM10, STORAGE_UNORM16,
};
use crate::{Profile, TextureFormat, ValueError};

/// How four moments are stored in a texel.
///
/// | storage | format | bits | moment bias | remark |
/// |---|---|---|---|---|
/// | [`Unorm16`](Storage::Unorm16) | rgba16unorm | 64 | 6e-5 | optimised basis; native only |
/// | [`Float16`](Storage::Float16) | rgba16float | 64 | 1e-3 | optimised basis less one half; everywhere, leaks four times as far |
/// | [`Float32`](Storage::Float32) | rgba32float | 128 | 1.5e-6 | raw moments; filtered in the shader where the device cannot |
/// | [`Packed64`](Storage::Packed64) | rg32uint | 64 | 1e-6 | non-linear; everywhere, filtered in the shader |
/// | [`Packed32`](Storage::Packed32) | r32uint | 32 | 1e-6 | the same, coarser; written once, by a blur that resolves |
///
/// Six moments take two such texels, all with the optimised basis, or the smallest of all:
///
/// | storage | format | bits | moment bias | remark |
/// |---|---|---|---|---|
/// | [`Unorm16`](Storage::Unorm16) | 2 x rgba16unorm | 128 | 1e-4 | native only |
/// | [`Float16`](Storage::Float16) | 2 x rgba16float | 128 | 1.5e-3 | everywhere |
/// | [`Float32`](Storage::Float32) | 2 x rgba32float | 256 | 1e-5 | |
/// | [`Unorm10`](Storage::Unorm10) | 2 x rgb10a2unorm | 64 | 6.5e-3 | everywhere, drawn by render passes; leaks twice as far as float16 |
/// | [`Unorm8`](Storage::Unorm8) | 2 x rgba8unorm | 64 | 1.2e-2 | everywhere, for light in the air alone, whose means are rounded once |
///
/// Light leaks behind an occluder over a distance that grows with the square root of the bias.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum Storage {
    /// 16-bit normalised channels with the optimised basis.
    Unorm16 = STORAGE_UNORM16 as isize,
    /// Half precision, the optimised basis less one half in every channel.
    Float16 = STORAGE_FLOAT16 as isize,
    /// Single precision, raw moments.
    Float32 = STORAGE_FLOAT32 as isize,
    /// 8-bit normalised channels: for bounded functions of depth, and for six moments of light in the air
    /// ([`MapEncoding::rectified`](crate::MapEncoding::rectified)).
    Unorm8 = STORAGE_UNORM8 as isize,
    /// 10-bit normalised channels, three to a texel: for six moments alone. Devices need not be able to write the format from
    /// compute shaders, so such maps are drawn ([`Storage::is_drawn`]).
    Unorm10 = STORAGE_UNORM10 as isize,
    /// Sums of 32-bit integers: a summed-area table, see [`SummedAreaTable`](crate::SummedAreaTable).
    Fixed32 = STORAGE_FIXED32 as isize,
    /// Four moments in 64 bits, non-linearly (WGSL module `packed_four_moments`): about as exact as `Float32`, on every device. Shaders
    /// gather and unpack four texels where a sampler would filter.
    Packed64 = STORAGE_PACKED64 as isize,
    /// The same in 32 bits (WGSL module `coarse_four_moments`): less exact, and rounded once alone, so that only the node `blur` with `resolve`
    /// writes it, and `shade_hard` reads it.
    Packed32 = STORAGE_PACKED32 as isize,
}

impl Storage {
    /// Every storage.
    pub const ALL: [Storage; 8] = [
        Storage::Unorm16,
        Storage::Float16,
        Storage::Float32,
        Storage::Unorm8,
        Storage::Unorm10,
        Storage::Fixed32,
        Storage::Packed64,
        Storage::Packed32,
    ];

    /// The storages of four moments.
    pub const OF_FOUR_MOMENTS: [Storage; 3] =
        [Storage::Unorm16, Storage::Float16, Storage::Float32];

    /// The name in graph files and on command lines.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Storage::Unorm16 => "unorm16",
            Storage::Float16 => "float16",
            Storage::Float32 => "float32",
            Storage::Unorm8 => "unorm8",
            Storage::Unorm10 => "unorm10",
            Storage::Fixed32 => "fixed32",
            Storage::Packed64 => "packed64",
            Storage::Packed32 => "packed32",
        }
    }

    /// The formats of textures with one, two and four channels.
    fn formats(self) -> (Option<TextureFormat>, Option<TextureFormat>, TextureFormat) {
        use TextureFormat as F;
        match self {
            Storage::Unorm16 => (Some(F::R16Unorm), Some(F::Rg16Unorm), F::Rgba16Unorm),
            Storage::Float16 => (Some(F::R16Float), Some(F::Rg16Float), F::Rgba16Float),
            Storage::Float32 => (Some(F::R32Float), Some(F::Rg32Float), F::Rgba32Float),
            Storage::Unorm8 => (None, None, F::Rgba8Unorm),
            Storage::Unorm10 => (None, None, F::Rgb10a2Unorm),
            Storage::Fixed32 => (None, Some(F::Rg32Uint), F::Rgba32Uint),
            Storage::Packed64 => (None, None, F::Rg32Uint),
            Storage::Packed32 => (None, None, F::R32Uint),
        }
    }

    /// The format of a texture with four channels.
    #[must_use]
    pub fn format(self) -> TextureFormat {
        self.formats().2
    }

    /// The format of a texture with 1, 2 or 4 channels, if there is one.
    #[must_use]
    pub fn format_of(self, channels: u32) -> Option<TextureFormat> {
        let (one, two, four) = self.formats();
        match channels {
            1 => one,
            2 => two,
            4 => Some(four),
            _ => None,
        }
    }

    /// The storage of four moments whose texture has this format.
    #[must_use]
    pub fn of_format(format: TextureFormat) -> Option<Storage> {
        Storage::OF_FOUR_MOMENTS
            .into_iter()
            .find(|storage| storage.format() == format)
    }

    /// The number by which the WGSL module `storage` knows this storage (`STORAGE_UNORM16` and so on).
    #[must_use]
    pub fn wgsl_index(self) -> u32 {
        self as u32
    }

    /// Whether maps are drawn by render passes, since compute shaders cannot write the format.
    #[must_use]
    pub fn is_drawn(self) -> bool {
        self == Storage::Unorm10
    }

    /// Whether several channels are packed into integers, which shaders unpack and no sampler filters.
    #[must_use]
    pub fn is_packed(self) -> bool {
        matches!(self, Storage::Packed64 | Storage::Packed32)
    }

    /// The functions of WGSL between texels and what textures hold of them, where that is something else.
    #[cfg(feature = "validate")]
    pub(crate) fn packing(self) -> &'static [&'static str] {
        match self {
            Storage::Packed64 => &["storage_pack", "storage_unpack"],
            Storage::Packed32 => &["coarse_four_moments_pack", "coarse_four_moments_unpack"],
            Storage::Unorm16
            | Storage::Float16
            | Storage::Float32
            | Storage::Unorm8
            | Storage::Unorm10
            | Storage::Fixed32 => &[],
        }
    }

    /// Whether texels are rounded too coarsely to be filtered and rounded again: the node `blur` with `resolve` alone makes such maps.
    #[must_use]
    pub fn is_written_once(self) -> bool {
        self == Storage::Packed32
    }

    /// Whether every device of the profile can make a map of this storage in a texture of this format.
    pub(crate) fn can_write(self, format: TextureFormat, profile: Profile) -> bool {
        let support = format.support(profile);
        if self.is_drawn() {
            support.renderable
        } else {
            support.storage_write
        }
    }

    /// The storage with the least leaking per bit that every device of the profile can write and filter.
    #[must_use]
    pub fn best_for(profile: Profile) -> Storage {
        match profile {
            Profile::WebgpuCore => Storage::Float16,
            Profile::Native | Profile::NativeAdapter | Profile::WebgpuTier1 => Storage::Unorm16,
        }
    }

    /// Checks that every device of the profile can write the storage; the error names one to use instead.
    pub fn check(self, profile: Profile) -> Result<(), ValueError> {
        self.check_format(self.format(), profile, Storage::best_for(profile))
    }

    /// Checks that every device of the profile can write the storage in textures of this format.
    pub(crate) fn check_format(
        self,
        format: TextureFormat,
        profile: Profile,
        alternative: Storage,
    ) -> Result<(), ValueError> {
        if self.can_write(format, profile) {
            return Ok(());
        }
        let feature = format.features_to_write();
        let message = format!(
            "storage '{self}' needs {format} as a storage texture, which the profile {profile} does not offer; request the \
             device with {feature}, or use storage '{alternative}' instead"
        );
        Err(ValueError::new("storage", message))
    }
}

impl fmt::Display for Storage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
