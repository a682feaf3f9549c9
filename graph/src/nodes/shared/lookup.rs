//! How shaders look up a filterable map: by a sampler, where the device can filter it, or by loads.

use moment_shadows::TextureFormat;

use super::VirtualModule;
use crate::{Binding, BindingResource, Capabilities};

/// Loads, for maps that no sampler can average.
pub(in crate::nodes) const LOADED: VirtualModule =
    ("moments_lookup", include_str!("moments_lookup_loaded.wgsl"));

/// The virtual module `moments_lookup` and the sampler that it binds, if it has one, for a map with mip levels or without.
/// `sampled` is false for maps that no sampler can average.
pub(in crate::nodes) fn moments_lookup(
    format: TextureFormat,
    mips: u32,
    anisotropy: u16,
    sampled: bool,
    capabilities: &Capabilities,
) -> (VirtualModule, Option<Binding>) {
    let minified = mips > 1;
    if !sampled
        || !capabilities.support(format).filterable
        || (minified && !capabilities.anisotropic_sampling)
    {
        return (LOADED, None);
    }
    let (text, sampler, anisotropy) = if minified {
        let text = include_str!("moments_lookup_minified.wgsl");
        (text, "anisotropic_sampler", anisotropy)
    } else {
        let text = include_str!("moments_lookup_sampled.wgsl");
        (text, "moments_sampler", 1)
    };
    let resource = BindingResource::Sampler {
        filtering: true,
        anisotropy,
    };
    (
        ("moments_lookup", text),
        Some(Binding::new(sampler, resource)),
    )
}
