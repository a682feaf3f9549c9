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
}

impl Profile {
    /// Every profile, least demanding first.
    pub const ALL: [Profile; 3] = [Profile::WebgpuCore, Profile::Native, Profile::NativeAdapter];

    /// The name used on command lines and in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Profile::WebgpuCore => "webgpu-core",
            Profile::Native => "native",
            Profile::NativeAdapter => "native-adapter",
        }
    }
}

impl fmt::Display for Profile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
