//! Bind group layouts, sampler states and usages, in WebGPU's own words: a host in any language hands them to its device as they
//! are.

use moment_shadows::TextureFormat;
use serde::{Deserialize, Serialize};

use crate::{Access, ResourceDesc};

/// The kind of a binding: what WebGPU's `GPUBindGroupLayoutEntry` has beside its number and visibility.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", rename_all_fields = "camelCase")]
pub enum BindingLayout {
    /// A buffer.
    Buffer {
        /// What it is bound as.
        #[serde(rename = "type")]
        ty: BufferKind,
        /// Whether an offset is given when it is bound.
        has_dynamic_offset: bool,
        /// The bytes that the shader reads or writes at least; 0 in a host's pass.
        min_binding_size: u32,
    },
    /// A sampler.
    Sampler {
        /// What it does.
        #[serde(rename = "type")]
        ty: SamplerKind,
    },
    /// A texture that is loaded or sampled.
    Texture {
        /// What a load gives.
        sample_type: SampleType,
        /// One layer or an array of them.
        view_dimension: ViewDimension,
        /// Whether texels have several samples.
        multisampled: bool,
    },
    /// A texture that is written.
    StorageTexture {
        /// How.
        access: StorageAccess,
        /// The format.
        format: TextureFormat,
        /// One layer.
        view_dimension: ViewDimension,
    },
}

/// WebGPU's `GPUBufferBindingType`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum BufferKind {
    /// Uniform data.
    Uniform,
    /// A storage buffer that is written.
    Storage,
    /// A storage buffer that is read.
    ReadOnlyStorage,
}

/// WebGPU's `GPUSamplerBindingType`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum SamplerKind {
    /// Blends texels.
    Filtering,
    /// Takes the nearest texel.
    NonFiltering,
    /// Compares with a reference.
    Comparison,
}

/// WebGPU's `GPUTextureSampleType`: what loading from a texture gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum SampleType {
    /// Depth.
    Depth,
    /// Floating point, can be sampled with filtering.
    Float,
    /// Floating point, loaded only.
    UnfilterableFloat,
    /// Unsigned integers, loaded only.
    Uint,
}

/// WebGPU's `GPUTextureViewDimension`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum ViewDimension {
    /// A view of one layer.
    #[serde(rename = "2d")]
    D2,
    /// A view of all layers.
    #[serde(rename = "2d-array")]
    D2Array,
}

/// WebGPU's `GPUStorageTextureAccess`; no pass reads what it stores.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum StorageAccess {
    /// Written.
    WriteOnly,
}

/// WebGPU's `GPUSamplerDescriptor`, whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct PlannedSampler {
    /// Along x.
    pub address_mode_u: AddressMode,
    /// Along y.
    pub address_mode_v: AddressMode,
    /// Between texels of a magnified lookup.
    pub mag_filter: FilterMode,
    /// Between texels of a minified lookup.
    pub min_filter: FilterMode,
    /// Between mip levels.
    pub mipmap_filter: FilterMode,
    /// The most probes of an anisotropic lookup, 1 to 16.
    pub max_anisotropy: u16,
    /// What a reference has to be compared with the texel, so that it passes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub compare: Option<CompareFunction>,
}

/// WebGPU's `GPUAddressMode`: all samplers of the nodes clamp.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum AddressMode {
    /// The texel at the edge repeats.
    ClampToEdge,
}

/// WebGPU's `GPUFilterMode`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum FilterMode {
    /// The nearest.
    Nearest,
    /// Blends.
    Linear,
}

/// WebGPU's `GPUCompareFunction`, of which nodes use two.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum CompareFunction {
    /// Less than the texel.
    Less,
    /// Greater than the texel.
    Greater,
}

/// The stage of WebGPU's `GPUShaderStage` that sees a pass's bindings.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "SCREAMING_SNAKE_CASE")]
pub enum Visibility {
    /// A compute pass.
    Compute,
    /// A fullscreen pass.
    Fragment,
}

/// A name of WebGPU's `GPUTextureUsage` or `GPUBufferUsage`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "SCREAMING_SNAKE_CASE")]
pub enum Usage {
    /// A texture is copied from; a buffer as well.
    CopySrc,
    /// A texture is loaded or sampled.
    TextureBinding,
    /// A texture is written as storage.
    StorageBinding,
    /// A texture is drawn to.
    RenderAttachment,
    /// A storage buffer.
    Storage,
}

impl Usage {
    /// Adds to the usages of a resource what an access needs.
    pub(crate) fn add(usages: &mut Vec<Self>, of: &ResourceDesc, access: Access) {
        Self::union(usages, &Self::needed(of, access));
    }

    /// What an access needs.
    pub(crate) fn needed(of: &ResourceDesc, access: Access) -> Vec<Self> {
        match of {
            ResourceDesc::Buffer { .. } => vec![Usage::Storage],
            ResourceDesc::Texture(texture) => {
                let all = [
                    (access.read, Usage::TextureBinding),
                    (access.storage_write, Usage::StorageBinding),
                    // WebGPU has no multisampled texture without it.
                    (
                        access.render_target || texture.samples > 1,
                        Usage::RenderAttachment,
                    ),
                ];
                let needed = all.into_iter().filter(|(is_needed, _)| *is_needed);
                needed.map(|(_, usage)| usage).collect()
            }
        }
    }

    /// Adds usages, in their order.
    pub(crate) fn union(usages: &mut Vec<Self>, further: &[Self]) {
        usages.extend(further);
        usages.sort();
        usages.dedup();
    }
}

impl PlannedSampler {
    /// A sampler that clamps and takes the nearest texel, or blends texels and mip levels.
    pub(crate) fn of_texels(filtering: bool, max_anisotropy: u16) -> Self {
        let filter = if filtering {
            FilterMode::Linear
        } else {
            FilterMode::Nearest
        };
        Self {
            address_mode_u: AddressMode::ClampToEdge,
            address_mode_v: AddressMode::ClampToEdge,
            mag_filter: filter,
            min_filter: filter,
            mipmap_filter: filter,
            max_anisotropy,
            compare: None,
        }
    }

    /// A comparison sampler, which filters between texels.
    pub(crate) fn of_comparisons(reversed: bool) -> Self {
        Self {
            mipmap_filter: FilterMode::Nearest,
            compare: Some(if reversed {
                CompareFunction::Less
            } else {
                CompareFunction::Greater
            }),
            ..Self::of_texels(true, 1)
        }
    }

    /// The kind of its binding.
    pub(crate) fn kind(&self) -> SamplerKind {
        match (self.compare, self.mag_filter) {
            (Some(_), _) => SamplerKind::Comparison,
            (None, FilterMode::Linear) => SamplerKind::Filtering,
            (None, FilterMode::Nearest) => SamplerKind::NonFiltering,
        }
    }
}
