//! Every technique with settings that are in use, as reports, shader checks and tables go through them.

use moment_shadows::{EsmFiltering, LayerSplits, MapEncoding, PcfTaps, Storage, Technique};

/// The storages of maps that are made by drawing a light's depth.
pub const STORAGES: [Storage; 7] = [
    Storage::Unorm8,
    Storage::Unorm10,
    Storage::Unorm16,
    Storage::Float16,
    Storage::Float32,
    Storage::Packed64,
    Storage::Packed32,
];

/// The filterable techniques with settings that suit a storage, and their encodings.
#[must_use]
pub fn filterable() -> Vec<MapEncoding> {
    let in_storage = |storage: Storage| {
        let techniques = Technique::examples().into_iter();
        techniques.filter_map(move |technique| MapEncoding::new(technique, storage).ok())
    };
    STORAGES.into_iter().flat_map(in_storage).collect()
}

/// The same technique with another of its settings, if it has one that makes another shader.
#[must_use]
pub fn variant(technique: &Technique) -> Option<Technique> {
    let mut variant = technique.clone();
    match &mut variant {
        Technique::Lvsm { splits, .. } => *splits = LayerSplits::Lloyd,
        Technique::Convolution { lower_bound, .. } => *lower_bound = false,
        _ => return None,
    }
    Some(variant)
}

/// The techniques that read the plain depth map, with a kernel of about the same width.
#[must_use]
pub fn reading_depth() -> Vec<Technique> {
    let mut all = Technique::examples();
    all.retain(Technique::reads_depth);
    all
}

/// What tells a technique apart from the same one with other settings.
#[must_use]
pub fn label(technique: &Technique) -> String {
    let taps = match technique {
        Technique::Pcf(PcfTaps::Box { .. }) => "_box",
        Technique::Pcf(PcfTaps::Gaussian { .. }) => "_gaussian",
        Technique::Pcf(PcfTaps::Weights(_)) => "_weights",
        Technique::Pcf(PcfTaps::Poisson { .. }) => "_poisson",
        Technique::Pcf(PcfTaps::Hardware { .. }) => "_hardware",
        Technique::Esm {
            filtering: EsmFiltering::Logarithmic,
            ..
        } => "_logarithmic",
        Technique::Lvsm {
            splits: LayerSplits::Lloyd,
            ..
        } => "_lloyd",
        Technique::Convolution {
            lower_bound: false, ..
        } => "_series",
        _ => "",
    };
    format!("{technique}{taps}")
}

/// A technique with its settings, as tables name it: `evsm4 40/5`.
#[must_use]
pub fn described(technique: &Technique) -> String {
    let settings = match technique {
        Technique::Esm {
            exponent: Some(exponent),
            ..
        }
        | Technique::Evsm2 {
            exponent: Some(exponent),
        } => format!(" {exponent}"),
        Technique::Evsm4 {
            positive: Some(positive),
            negative: Some(negative),
        } => format!(" {positive}/{negative}"),
        Technique::Lvsm { layers, .. } => format!(" {layers}"),
        Technique::Convolution { terms, .. } => format!(" {terms}"),
        _ => String::new(),
    };
    format!("{}{settings}", label(technique))
}
