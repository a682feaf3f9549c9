//! The registry: the WGSL modules of the library, as text that is part of the crate.

/// One importable WGSL module: `wgsl/<folder>/<name>.wgsl`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Module {
    /// The folder, which says the stage of the work: the name after `moment_shadows::` in an import.
    pub folder: &'static str,
    /// The name after the folder.
    pub name: &'static str,
    /// The text of the module, imports included.
    pub source: &'static str,
}

macro_rules! modules {
    ($($folder:literal: [$($name:literal),* $(,)?]),* $(,)?) => {
        &[$($(Module {
            folder: $folder,
            name: $name,
            source: include_str!(concat!("../../wgsl/", $folder, "/", $name, ".wgsl")),
        }),*),*]
    };
}

/// Every WGSL module of the library, folder by folder in the order of the work, by name within each.
#[must_use]
pub fn modules() -> &'static [Module] {
    const MODULES: &[Module] = modules![
        "maths": ["angle", "disk_samples", "hankel", "split_sum", "two_diracs"],
        "map": ["depth", "map_load", "map_lookup", "map_region", "minification", "storage"],
        "moments": ["enclosed_moments", "four_moments", "six_moments", "two_moments"],
        "bounds": ["chebyshev", "hamburger4", "hamburger6", "hausdorff4"],
        "techniques": ["convolution", "exponential", "exponential_variance", "layered_variance", "lloyd", "percentage_closer", "percentage_closer_hardware", "percentage_closer_soft"],
        "filter": ["gaussian", "summed_area_encoding", "summed_area_table"],
        "shade": ["area_light", "leak_reduction", "moment_soft_shadows", "receiver_bias", "receiver_plane", "soft_blockers"],
        "air": ["phase_function", "rectified_frame", "scattering_weights", "single_scattering"],
    ];
    MODULES
}
