//! Every technique with settings that are in use, as reports, shader checks and tables go through them.

use moment_shadows::{
    EsmFiltering, Finite, LayerSplits, MapEncoding, PcfTaps, Pcss, Storage, Technique,
};

/// The storages of maps that are made by drawing a light's depth.
pub const STORAGES: [Storage; 5] = [
    Storage::Unorm8,
    Storage::Unorm10,
    Storage::Unorm16,
    Storage::Float16,
    Storage::Float32,
];

/// The filterable techniques with settings that suit a storage, and their encodings.
#[must_use]
pub fn filterable() -> Vec<MapEncoding> {
    STORAGES
        .into_iter()
        .flat_map(|storage| {
            settings(storage)
                .into_iter()
                .filter_map(move |technique| MapEncoding::new(technique, storage).ok())
        })
        .collect()
}

fn settings(storage: Storage) -> Vec<Technique> {
    let exponent = |largest: f32, wished: f32| finite(largest.min(wished));
    let esm = |filtering| {
        let limits = Technique::Esm {
            exponent: finite(1.0),
            filtering,
        };
        Technique::Esm {
            exponent: exponent(limits.largest_exponent(storage).unwrap_or(1.0), 80.0),
            filtering,
        }
    };
    let limits = Technique::Evsm2 {
        exponent: finite(1.0),
    };
    let largest = limits.largest_exponent(storage).unwrap_or(1.0);
    vec![
        esm(EsmFiltering::Linear),
        esm(EsmFiltering::Logarithmic),
        Technique::Vsm,
        Technique::Evsm2 {
            exponent: exponent(largest, 40.0),
        },
        Technique::Evsm4 {
            positive: exponent(largest, 40.0),
            negative: exponent(largest, 5.0),
        },
        Technique::Lvsm {
            layers: 4,
            overlap: finite(0.02),
            splits: LayerSplits::Uniform,
        },
        Technique::Convolution {
            terms: 8,
            lower_bound: true,
        },
        Technique::Hamburger4,
        Technique::Hausdorff4,
        Technique::Hamburger6,
    ]
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
    let weights = [1.0, 2.0, 3.0, 2.0, 1.0].map(finite).to_vec();
    let mut all = vec![Technique::Binary];
    all.extend(
        [
            PcfTaps::Box { radius: 2 },
            PcfTaps::Gaussian {
                radius: 4,
                sigma: finite(2.4),
            },
            PcfTaps::Weights(weights),
            PcfTaps::Poisson {
                radius: finite(4.0),
            },
            PcfTaps::Hardware {
                radius: 2,
                reversed: false,
            },
        ]
        .map(Technique::Pcf),
    );
    all.push(Technique::Pcss(Pcss {
        search_taps: 16,
        filter_taps: 32,
    }));
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
        Technique::Esm { exponent, .. } | Technique::Evsm2 { exponent } => format!(" {exponent}"),
        Technique::Evsm4 { positive, negative } => format!(" {positive}/{negative}"),
        Technique::Lvsm { layers, .. } => format!(" {layers}"),
        Technique::Convolution { terms, .. } => format!(" {terms}"),
        _ => String::new(),
    };
    format!("{}{settings}", label(technique))
}

/// A literal of this file.
fn finite(value: f32) -> Finite {
    Finite::new(value).unwrap_or_default()
}
