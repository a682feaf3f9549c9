//! How shaders look up a filterable map: by a sampler, where the device can filter it, or by loads.

use moment_shadows::TextureFormat;

use crate::{BindingResource, Capabilities};

/// The text of the virtual module `moments_lookup` and the sampler that it binds, if it has one, for a map with mip levels
/// or without. `sampled` is false for maps that no sampler can average.
pub(super) fn moments_lookup(
    format: TextureFormat,
    mips: u32,
    anisotropy: u16,
    sampled: bool,
    capabilities: &Capabilities,
) -> (&'static str, Option<BindingResource>) {
    let minified = mips > 1;
    let sampled = sampled
        && capabilities.support(format).filterable
        && (capabilities.anisotropic_sampling || !minified);
    let text = match (sampled, minified) {
        (true, false) => include_str!("moments_lookup_sampled.wgsl"),
        (true, true) => include_str!("moments_lookup_minified.wgsl"),
        (false, _) => include_str!("moments_lookup_loaded.wgsl"),
    };
    let sampler = sampled.then_some(BindingResource::Sampler {
        filtering: true,
        anisotropy: if minified { anisotropy } else { 1 },
    });
    (text, sampler)
}
