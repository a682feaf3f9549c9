//! What a shader may rely on: core WebGPU, native devices, or one adapter's own texture usages.

use core::fmt;

/// The set of capabilities that a shader or a storage is checked against.
///
/// A profile never asks for more than its name says; faster paths are chosen per device when a graph is compiled.
#[derive(
    Clone, Copy, Debug, Default, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Profile {
    /// WebGPU without any optional feature: what every browser and every device offers.
    #[default]
    WebgpuCore,
    /// Native devices with 16-bit normalised formats (`TEXTURE_FORMAT_16BIT_NORM` in wgpu).
    Native,
    /// [`Profile::Native`] with the texture usages and sample counts that the adapter at hand reports
    /// (`TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES` in wgpu).
    NativeAdapter,
    /// WebGPU with its optional feature `texture-formats-tier1`: 16-bit normalised formats and half precision of one or two channels
    /// can be stored, and the former not filtered.
    WebgpuTier1,
}

impl Profile {
    /// Every profile: those of wgpu's devices, least demanding first, then the further one of browsers.
    pub const ALL: [Profile; 4] = [
        Profile::WebgpuCore,
        Profile::Native,
        Profile::NativeAdapter,
        Profile::WebgpuTier1,
    ];

    /// The name used on command lines and in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Profile::WebgpuCore => "webgpu-core",
            Profile::Native => "native",
            Profile::NativeAdapter => "native-adapter",
            Profile::WebgpuTier1 => "webgpu-tier1",
        }
    }

    /// Whether it is WebGPU's own, so that browsers have to take what is checked against it.
    #[must_use]
    pub fn is_of_browsers(self) -> bool {
        match self {
            Profile::WebgpuCore | Profile::WebgpuTier1 => true,
            Profile::Native | Profile::NativeAdapter => false,
        }
    }
}

impl fmt::Display for Profile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
