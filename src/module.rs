//! The registry: the WGSL modules of the library, as text that is part of the crate.

/// One importable WGSL module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Module {
    /// The name after `moment_shadows::` in an import.
    pub name: &'static str,
    /// The text of the module, imports included.
    pub source: &'static str,
}

macro_rules! modules {
    ($($name:literal),* $(,)?) => {
        &[$(Module { name: $name, source: include_str!(concat!("../wgsl/", $name, ".wgsl")) }),*]
    };
}

/// Every WGSL module of the library, by name in alphabetical order.
#[must_use]
pub fn modules() -> &'static [Module] {
    const MODULES: &[Module] = modules![
        "angle",
        "area_light",
        "convolution",
        "depth",
        "disk_samples",
        "enclosed_moments",
        "exponential",
        "exponential_variance",
        "gaussian",
        "hamburger",
        "hamburger6",
        "hankel",
        "hausdorff",
        "layered_variance",
        "leak_reduction",
        "lloyd",
        "map_load",
        "map_lookup",
        "map_region",
        "minification",
        "moment_soft_shadows",
        "moments",
        "percentage_closer",
        "percentage_closer_hardware",
        "percentage_closer_soft",
        "phase_function",
        "receiver_bias",
        "receiver_plane",
        "rectified_frame",
        "scattering_weights",
        "single_scattering",
        "six_moments",
        "soft_blockers",
        "split_sum",
        "storage",
        "summed_area_encoding",
        "summed_area_table",
        "two_diracs",
        "variance",
    ];
    MODULES
}
