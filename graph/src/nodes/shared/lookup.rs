//! How shaders look up a filterable map: by a sampler, where the device can filter it, or by loads.

use moment_shadows::{MapEncoding, Storage};

use super::Specialization;
use crate::{Binding, BindingResource, Capabilities};

/// Adds the module `moments_lookup` for a map with `levels` mip levels, and gives the sampler that it binds, if it has one.
pub(in crate::nodes) fn moments_lookup(
    specialization: Specialization,
    capabilities: &Capabilities,
    encoding: &MapEncoding,
    levels: u32,
    anisotropy: u16,
) -> (Specialization, Option<Binding>) {
    // Logarithms and packed texels are averaged by no sampler, and have no mip levels.
    let averaged = encoding.averaged_by_samplers();
    let levels = if averaged { levels } else { 1 };
    let specialization = specialization
        .unsigned("LEVELS", levels)
        .constant("ANISOTROPY", format_args!("{anisotropy}.0"));
    let minified = levels > 1;
    let (text, sampler) = if encoding.storage().is_packed() {
        let text = if encoding.storage() == Storage::Packed32 {
            include_str!("moments_lookup_coarse.wgsl")
        } else {
            include_str!("moments_lookup_packed.wgsl")
        };
        (text, Some(("moments_sampler", false, 1)))
    } else if !averaged
        || !capabilities.support(encoding.format()).filterable
        || (minified && !capabilities.anisotropic_sampling)
    {
        (include_str!("moments_lookup_loaded.wgsl"), None)
    } else if minified {
        let text = include_str!("moments_lookup_minified.wgsl");
        (text, Some(("anisotropic_sampler", true, anisotropy)))
    } else {
        let text = include_str!("moments_lookup_sampled.wgsl");
        (text, Some(("moments_sampler", true, 1)))
    };
    let binding = sampler.map(|(variable, filtering, anisotropy)| {
        let sampler = BindingResource::Sampler {
            filtering,
            anisotropy,
        };
        Binding::new(variable, sampler)
    });
    (specialization.module("moments_lookup", text), binding)
}
