//! Texture formats, by their WebGPU names, and what each profile allows them.

use core::fmt;

use serde::{Deserialize, Serialize};

use crate::Profile;

/// A texture format that nodes and hosts exchange. Named as in WebGPU, and independent of graphics libraries.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum TextureFormat {
    /// One channel of 8 bits in [0, 1].
    R8Unorm,
    /// Four channels of 8 bits in [0, 1].
    Rgba8Unorm,
    /// One channel of 16 bits in [0, 1].
    R16Unorm,
    /// Two channels of 16 bits in [0, 1].
    Rg16Unorm,
    /// One half-precision channel.
    R16Float,
    /// Two half-precision channels.
    Rg16Float,
    /// One single-precision channel.
    R32Float,
    /// Two single-precision channels.
    Rg32Float,
    /// Three channels of 10 bits and one of 2 bits in [0, 1].
    Rgb10a2Unorm,
    /// Four channels of 16 bits in [0, 1].
    Rgba16Unorm,
    /// Four half-precision channels.
    Rgba16Float,
    /// Four single-precision channels.
    Rgba32Float,
    /// One channel of 32-bit integers.
    R32Uint,
    /// Two channels of 32-bit integers.
    Rg32Uint,
    /// Four channels of 32-bit integers.
    Rgba32Uint,
    /// Depth of 16 bits in [0, 1].
    Depth16Unorm,
    /// Single-precision depth.
    Depth32Float,
    /// Depth of at least 24 bits in [0, 1]: of integers or in single precision, as the device likes.
    Depth24Plus,
    /// The same beside a stencil of 8 bits. Nodes read its depth.
    #[serde(rename = "depth24plus-stencil8")]
    Depth24PlusStencil8,
    /// Single-precision depth beside a stencil of 8 bits. Nodes read its depth.
    #[serde(rename = "depth32float-stencil8")]
    Depth32FloatStencil8,
}

/// What a format can be used for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FormatSupport {
    /// Can be sampled with a filtering sampler.
    pub filterable: bool,
    /// Can be written as a storage texture.
    pub storage_write: bool,
    /// Can be a render target (a depth target, for depth formats).
    pub renderable: bool,
    /// Can be blended into.
    pub blendable: bool,
}

impl TextureFormat {
    /// Every format.
    pub const ALL: [TextureFormat; 20] = [
        TextureFormat::R8Unorm,
        TextureFormat::Rgba8Unorm,
        TextureFormat::R16Unorm,
        TextureFormat::Rg16Unorm,
        TextureFormat::R16Float,
        TextureFormat::Rg16Float,
        TextureFormat::R32Float,
        TextureFormat::Rg32Float,
        TextureFormat::Rgb10a2Unorm,
        TextureFormat::Rgba16Unorm,
        TextureFormat::Rgba16Float,
        TextureFormat::Rgba32Float,
        TextureFormat::R32Uint,
        TextureFormat::Rg32Uint,
        TextureFormat::Rgba32Uint,
        TextureFormat::Depth16Unorm,
        TextureFormat::Depth32Float,
        TextureFormat::Depth24Plus,
        TextureFormat::Depth24PlusStencil8,
        TextureFormat::Depth32FloatStencil8,
    ];

    /// The name, channels, and bytes of a texel.
    fn row(self) -> (&'static str, u32, u32) {
        match self {
            TextureFormat::R8Unorm => ("r8unorm", 1, 1),
            TextureFormat::Rgba8Unorm => ("rgba8unorm", 4, 4),
            TextureFormat::R16Unorm => ("r16unorm", 1, 2),
            TextureFormat::Rg16Unorm => ("rg16unorm", 2, 4),
            TextureFormat::R16Float => ("r16float", 1, 2),
            TextureFormat::Rg16Float => ("rg16float", 2, 4),
            TextureFormat::R32Float => ("r32float", 1, 4),
            TextureFormat::Rg32Float => ("rg32float", 2, 8),
            TextureFormat::Rgb10a2Unorm => ("rgb10a2unorm", 4, 4),
            TextureFormat::Rgba16Unorm => ("rgba16unorm", 4, 8),
            TextureFormat::Rgba16Float => ("rgba16float", 4, 8),
            TextureFormat::Rgba32Float => ("rgba32float", 4, 16),
            TextureFormat::R32Uint => ("r32uint", 1, 4),
            TextureFormat::Rg32Uint => ("rg32uint", 2, 8),
            TextureFormat::Rgba32Uint => ("rgba32uint", 4, 16),
            TextureFormat::Depth16Unorm => ("depth16unorm", 1, 2),
            TextureFormat::Depth32Float => ("depth32float", 1, 4),
            TextureFormat::Depth24Plus => ("depth24plus", 1, 4),
            TextureFormat::Depth24PlusStencil8 => ("depth24plus-stencil8", 1, 4),
            // What devices take, padded.
            TextureFormat::Depth32FloatStencil8 => ("depth32float-stencil8", 1, 8),
        }
    }

    /// The WebGPU (and WGSL) name.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.row().0
    }

    /// How many channels a texel has: 1, 2 or 4.
    #[must_use]
    pub fn channels(self) -> u32 {
        self.row().1
    }

    /// Bytes of one texel (of one sample, where multisampled).
    #[must_use]
    pub fn bytes_per_texel(self) -> u32 {
        self.row().2
    }

    /// Whether this is a depth format.
    #[must_use]
    pub fn is_depth(self) -> bool {
        self.depth_step().is_some() && self != TextureFormat::R32Float
    }

    /// The largest step between neighbouring depths in [0, 1] of a format that stores depth; `None` for others.
    #[must_use]
    pub fn depth_step(self) -> Option<f64> {
        use TextureFormat as F;
        match self {
            F::Depth16Unorm => Some(1.0 / 65535.0),
            F::Depth24Plus | F::Depth24PlusStencil8 => Some(1.0 / 16_777_215.0),
            F::Depth32Float | F::Depth32FloatStencil8 | F::R32Float => {
                Some(0.5 * f64::from(f32::EPSILON))
            }
            F::R8Unorm | F::Rgba8Unorm | F::R16Unorm | F::Rg16Unorm | F::Rgba16Unorm => None,
            F::R16Float | F::Rg16Float | F::Rgba16Float | F::Rg32Float | F::Rgba32Float => None,
            F::Rgb10a2Unorm | F::R32Uint | F::Rg32Uint | F::Rgba32Uint => None,
        }
    }

    /// Whether depth is stored in floating point whatever the device: steps shrink with what is stored.
    pub(crate) fn is_floating_depth(self) -> bool {
        use TextureFormat as F;
        matches!(
            self,
            F::Depth32Float | F::Depth32FloatStencil8 | F::R32Float
        )
    }

    /// Whether texels are integers, which no sampler filters.
    #[must_use]
    pub fn is_integer(self) -> bool {
        use TextureFormat as F;
        matches!(self, F::R32Uint | F::Rg32Uint | F::Rgba32Uint)
    }

    /// The feature of WebGPU that the format exists by, in browsers; `None` where every device has it.
    #[must_use]
    pub fn webgpu_feature(self) -> Option<&'static str> {
        use TextureFormat as F;
        match self {
            F::R16Unorm | F::Rg16Unorm | F::Rgba16Unorm => Some(Self::TIER1),
            F::Depth32FloatStencil8 => Some("depth32float-stencil8"),
            F::R8Unorm | F::Rgba8Unorm | F::Rgb10a2Unorm => None,
            F::R16Float | F::Rg16Float | F::Rgba16Float => None,
            F::R32Float | F::Rg32Float | F::Rgba32Float => None,
            F::R32Uint | F::Rg32Uint | F::Rgba32Uint => None,
            F::Depth16Unorm | F::Depth32Float | F::Depth24Plus | F::Depth24PlusStencil8 => None,
        }
    }

    /// The feature of WebGPU by which browsers store more formats.
    pub const TIER1: &'static str = "texture-formats-tier1";

    /// The wgpu feature to request of a device so that shaders can write a format that not every device lets them.
    #[must_use]
    pub fn feature_to_write(self) -> &'static str {
        let is_norm16 = matches!(self, Self::R16Unorm | Self::Rg16Unorm | Self::Rgba16Unorm);
        if is_norm16 {
            "TEXTURE_FORMAT_16BIT_NORM"
        } else {
            "TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES"
        }
    }

    /// The features to request of a device so that shaders can write the format, in wgpu's words and WebGPU's.
    #[must_use]
    pub fn features_to_write(self) -> String {
        let (wgpu, webgpu) = (self.feature_to_write(), Self::TIER1);
        format!("the feature {wgpu} of wgpu ('{webgpu}' in browsers)")
    }

    /// The features to request of a device so that it blends into the format where that is optional, in wgpu's words and WebGPU's. An
    /// adapter may not have it all the same.
    #[must_use]
    pub fn features_to_blend(self) -> Option<String> {
        use TextureFormat as F;
        let (wgpu, webgpu) = match self {
            F::R16Unorm | F::Rg16Unorm | F::Rgba16Unorm => (
                "TEXTURE_FORMAT_16BIT_NORM and TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES",
                Self::TIER1,
            ),
            F::R32Float | F::Rg32Float | F::Rgba32Float => {
                ("FLOAT32_BLENDABLE", "float32-blendable")
            }
            F::R8Unorm | F::Rgba8Unorm | F::R16Float | F::Rg16Float | F::Rgba16Float => {
                return None;
            }
            F::Rgb10a2Unorm | F::R32Uint | F::Rg32Uint | F::Rgba32Uint => return None,
            F::Depth16Unorm | F::Depth32Float | F::Depth24Plus | F::Depth24PlusStencil8 => {
                return None;
            }
            F::Depth32FloatStencil8 => return None,
        };
        Some(format!("{wgpu} of wgpu ('{webgpu}' in browsers)"))
    }

    /// What every device of the profile can do with the format, without optional features beyond the profile's own.
    #[must_use]
    pub fn support(self, profile: Profile) -> FormatSupport {
        use TextureFormat as F;
        let (filterable, storage_write, renderable, blendable) = match self {
            F::R8Unorm | F::Rgb10a2Unorm => (true, profile == Profile::WebgpuTier1, true, true),
            // Only features that an adapter adds let them be written as storage.
            F::R16Float | F::Rg16Float => {
                let stored = matches!(profile, Profile::NativeAdapter | Profile::WebgpuTier1);
                (true, stored, true, true)
            }
            F::Rgba8Unorm | F::Rgba16Float => (true, true, true, true),
            // Filtering and blending of single precision are optional features everywhere.
            F::R32Float | F::Rg32Float | F::Rgba32Float => (false, true, true, false),
            F::R32Uint | F::Rg32Uint | F::Rgba32Uint => (false, true, true, false),
            F::R16Unorm | F::Rg16Unorm | F::Rgba16Unorm => match profile {
                Profile::WebgpuCore => (false, false, false, false),
                Profile::Native | Profile::NativeAdapter => (true, true, false, false),
                // WebGPU counts them among the formats that are not filtered.
                Profile::WebgpuTier1 => (false, true, true, true),
            },
            F::Depth16Unorm | F::Depth32Float | F::Depth24Plus | F::Depth24PlusStencil8 => {
                (false, false, true, false)
            }
            // An optional feature of devices.
            F::Depth32FloatStencil8 => (false, false, false, false),
        };
        FormatSupport {
            filterable,
            storage_write,
            renderable,
            blendable,
        }
    }
}

impl fmt::Display for TextureFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
