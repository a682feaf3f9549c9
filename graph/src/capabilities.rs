//! What the device offers that a graph is compiled for.

use moment_shadows::{FormatSupport, Profile, TextureFormat};

/// What a plan may rely on. Faster paths are chosen by it when a graph is compiled.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Capabilities {
    /// The profile: which formats can be written, sampled and drawn to.
    pub profile: Profile,
    /// Whether single-precision textures can be sampled with a filtering sampler.
    pub float32_filterable: bool,
    /// Formats that can be drawn to and blended into beyond those of the profile.
    pub blended: Vec<TextureFormat>,
    /// Whether samplers take the probes of a minified lookup, rather than the shader. Software adapters need many times as
    /// long for an anisotropic lookup, and llvmpipe ignores the gradients that it is given then: whatever they and the clamp are, it
    /// reads mip level 0 where neighbouring invocations look up one place.
    pub anisotropic_sampling: bool,
    /// Whether the processor runs the shaders: large tiles in few invocations then serve better than many invocations.
    pub software_adapter: bool,
    /// Samples per texel that depth textures can have.
    pub depth_samples: Vec<u32>,
    /// The largest width or height of a texture.
    pub max_texture_size: u32,
    /// The largest number of layers of a texture.
    pub max_texture_layers: u32,
    /// The largest number of workgroups of a dispatch in one dimension.
    pub max_workgroups: u32,
    /// The most bytes of a uniform binding: what limits regions and views.
    pub max_uniform_size: u32,
    /// Offsets of uniform buffers are multiples of this.
    pub uniform_alignment: u32,
    /// The index of the bind group that the host leaves to the plan's passes.
    pub bind_group: u32,
}

impl Capabilities {
    /// What every device of the profile offers, with WebGPU's default limits.
    #[must_use]
    pub fn of_profile(profile: Profile) -> Self {
        Self {
            profile,
            float32_filterable: false,
            blended: Vec::new(),
            anisotropic_sampling: true,
            software_adapter: false,
            depth_samples: vec![1, 4],
            max_texture_size: 8192,
            max_texture_layers: 256,
            max_workgroups: 65535,
            max_uniform_size: 65536,
            uniform_alignment: 256,
            bind_group: 0,
        }
    }

    /// What can be done with a format.
    #[must_use]
    pub fn support(&self, format: TextureFormat) -> FormatSupport {
        use TextureFormat::{R32Float, Rg32Float, Rgba32Float};
        let mut support = format.support(self.profile);
        let is_float32 = matches!(format, R32Float | Rg32Float | Rgba32Float);
        support.filterable |= is_float32 && self.float32_filterable;
        if self.blended.contains(&format) {
            (support.renderable, support.blendable) = (true, true);
        }
        support
    }

    /// What a device offers. The profile follows from the device's features; the limits are the device's.
    #[cfg(feature = "wgpu")]
    #[must_use]
    pub fn of_device(adapter: &wgpu::Adapter, device: &wgpu::Device) -> Self {
        let features = device.features();
        let adapter_specific =
            features.contains(wgpu::Features::TEXTURE_ADAPTER_SPECIFIC_FORMAT_FEATURES);
        let profile = if !features.contains(wgpu::Features::TEXTURE_FORMAT_16BIT_NORM) {
            Profile::WebgpuCore
        } else if adapter_specific {
            Profile::NativeAdapter
        } else {
            Profile::Native
        };
        let flags = adapter
            .get_texture_format_features(wgpu::TextureFormat::Depth32Float)
            .flags;
        let mut depth_samples = vec![1, 2, 4, 8];
        depth_samples.retain(|&count| {
            [1, 4].contains(&count) || (adapter_specific && flags.sample_count_supported(count))
        });
        // What wgpu lets this device do; its adapter may do more.
        let is_blended = |format: &TextureFormat| {
            let format = crate::TextureDesc::new(*format, [1; 2]).wgpu_format();
            let found = if adapter_specific {
                adapter.get_texture_format_features(format)
            } else {
                format.guaranteed_format_features(features)
            };
            let blendable = wgpu::TextureFormatFeatureFlags::BLENDABLE;
            features.contains(format.required_features())
                && found.flags.contains(blendable)
                && found
                    .allowed_usages
                    .contains(wgpu::TextureUsages::RENDER_ATTACHMENT)
        };
        let blended = TextureFormat::ALL.into_iter().filter(is_blended);
        let software_adapter = adapter.get_info().device_type == wgpu::DeviceType::Cpu;
        let limits = device.limits();
        Self {
            blended: blended
                .filter(|format| !format.support(profile).blendable)
                .collect(),
            float32_filterable: features.contains(wgpu::Features::FLOAT32_FILTERABLE),
            anisotropic_sampling: !software_adapter,
            software_adapter,
            depth_samples,
            max_texture_size: limits.max_texture_dimension_2d,
            max_texture_layers: limits.max_texture_array_layers,
            max_workgroups: limits.max_compute_workgroups_per_dimension,
            max_uniform_size: u32::try_from(limits.max_uniform_buffer_binding_size)
                .unwrap_or(u32::MAX),
            uniform_alignment: limits.min_uniform_buffer_offset_alignment,
            ..Self::of_profile(profile)
        }
    }
}
