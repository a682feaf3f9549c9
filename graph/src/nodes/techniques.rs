//! Techniques as virtual modules: how a node's shader encodes, filters and evaluates the map that it is described for.
//!
//! Each is a thin adapter between the library's modules and a node's shader, which has one interface for all of them.

use moment_shadows::{EsmFiltering, LayerSplits, MapEncoding, PcfTaps, Technique};

use super::shared::Specialization;
use crate::{Binding, CountRule, GraphError, GraphErrorKind, Slot, TextureRule, bind};

/// The name and text of a virtual module.
pub(super) type VirtualModule = (&'static str, &'static str);

/// The slot of these splits: one layer per layer of the map, the splits in two texels.
pub(super) const SPLITS: &str = "splits";

/// Constants that the adapters of a technique import.
pub(super) fn specialize(specialization: Specialization, technique: &Technique) -> Specialization {
    let float = |value: f32| format!("f32({value:?})");
    match technique {
        Technique::Esm {
            exponent,
            filtering,
        } => specialization
            .constant("EXPONENT", &float(exponent.get()))
            .constant(
                "LOGARITHMIC",
                &(*filtering == EsmFiltering::Logarithmic).to_string(),
            ),
        Technique::Evsm2 { exponent } => specialization
            // The negative warp is not stored.
            .constant("EXPONENTS", &format!("vec2f({:?}, 0.0)", exponent.get()))
            .constant("BOTH_WARPS", "false"),
        Technique::Evsm4 { positive, negative } => specialization
            .constant(
                "EXPONENTS",
                &format!("vec2f({:?}, {:?})", positive.get(), negative.get()),
            )
            .constant("BOTH_WARPS", "true"),
        Technique::Lvsm {
            layers,
            overlap,
            splits,
        } => {
            let specialization = specialization
                .constant("LAYERS", &format!("{layers}u"))
                .constant("LAYER_OVERLAP", &float(overlap.get()));
            let Some(mut known) = splits.known(*layers) else {
                return specialization;
            };
            known.resize(8, 1.0);
            let vector = |range: &[f32]| {
                let values: Vec<String> = range.iter().map(|value| format!("{value:?}")).collect();
                format!("vec4f({})", values.join(", "))
            };
            specialization
                .constant("LAYER_SPLITS_LOW", &vector(&known[..4]))
                .constant("LAYER_SPLITS_HIGH", &vector(&known[4..]))
        }
        Technique::Convolution { terms, lower_bound } => specialization
            .constant("TERMS", &format!("{terms}u"))
            .constant("LOWER_BOUND", &lower_bound.to_string()),
        Technique::Pcf(taps) => match taps {
            PcfTaps::Box { radius } | PcfTaps::Hardware { radius, .. } => {
                specialization.constant("RADIUS", &format!("{radius}i"))
            }
            PcfTaps::Gaussian { radius, sigma } => specialization
                .constant("RADIUS", &format!("{radius}i"))
                .constant("SIGMA", &float(sigma.get())),
            PcfTaps::Poisson { radius } => {
                specialization.constant("DISK_RADIUS", &float(radius.get()))
            }
            PcfTaps::Weights(weights) => {
                let mut flat: Vec<f32> = weights.iter().map(|weight| weight.get()).collect();
                flat.resize(4 * 33, 0.0);
                let values: Vec<String> = flat
                    .chunks_exact(4)
                    .map(|four| {
                        format!(
                            "vec4f({:?}, {:?}, {:?}, {:?})",
                            four[0], four[1], four[2], four[3]
                        )
                    })
                    .collect();
                specialization
                    .constant("RADIUS", &format!("{}i", weights.len() / 2))
                    .text(&format!(
                        "fn kernel_weights() -> array<vec4f, 33> {{\n    return array<vec4f, 33>({});\n}}\n",
                        values.join(", ")
                    ))
            }
        },
        Technique::Pcss(taps) => specialization
            .constant("SEARCH_TAPS", &format!("{}u", taps.search_taps))
            .constant("FILTER_TAPS", &format!("{}u", taps.filter_taps)),
        _ => specialization,
    }
}

/// How a map is encoded: `encoding_channels` and `encoding_texel`.
pub(super) fn encoding(technique: &Technique) -> VirtualModule {
    let text = match technique {
        Technique::Esm { .. } => include_str!("techniques/encode_exponential.wgsl"),
        Technique::Vsm => include_str!("techniques/encode_variance.wgsl"),
        Technique::Evsm2 { .. } | Technique::Evsm4 { .. } => {
            include_str!("techniques/encode_exponential_variance.wgsl")
        }
        Technique::Lvsm { .. } => include_str!("techniques/encode_layered_variance.wgsl"),
        Technique::Convolution { .. } => include_str!("techniques/encode_convolution.wgsl"),
        Technique::Hamburger6 => include_str!("techniques/encode_six_moments.wgsl"),
        _ => include_str!("techniques/encode_four_moments.wgsl"),
    };
    ("map_encoding", text)
}

/// Whether the encoding has a constant for the plane that it makes.
pub(super) fn encodes_planes(technique: &Technique) -> bool {
    matches!(
        technique,
        Technique::Lvsm { .. } | Technique::Convolution { .. } | Technique::Hamburger6
    )
}

/// How texels are averaged: `filtering_value` and `filtering_texel`.
pub(super) fn filtering(technique: &Technique) -> VirtualModule {
    let text = if is_logarithmic(technique) {
        include_str!("techniques/filter_logarithmic.wgsl")
    } else {
        include_str!("techniques/filter_linear.wgsl")
    };
    ("map_filtering", text)
}

/// Whether texels are logarithms, which no sampler can average.
pub(super) fn is_logarithmic(technique: &Technique) -> bool {
    matches!(
        technique,
        Technique::Esm {
            filtering: EsmFiltering::Logarithmic,
            ..
        }
    )
}

/// How a fragment is shaded: `technique_shadow_intensity` and what it imports.
pub(super) fn evaluation(technique: &Technique) -> Vec<VirtualModule> {
    let text = match technique {
        Technique::Binary => include_str!("techniques/evaluate_binary.wgsl"),
        Technique::Pcf(PcfTaps::Box { .. }) => include_str!("techniques/evaluate_pcf_box.wgsl"),
        Technique::Pcf(PcfTaps::Gaussian { .. }) => {
            include_str!("techniques/evaluate_pcf_gaussian.wgsl")
        }
        Technique::Pcf(PcfTaps::Weights(_)) => {
            include_str!("techniques/evaluate_pcf_weights.wgsl")
        }
        Technique::Pcf(PcfTaps::Poisson { .. }) => {
            include_str!("techniques/evaluate_pcf_poisson.wgsl")
        }
        Technique::Pcf(PcfTaps::Hardware { .. }) => {
            include_str!("techniques/evaluate_pcf_hardware.wgsl")
        }
        Technique::Pcss(_) => include_str!("techniques/evaluate_pcss.wgsl"),
        Technique::Esm { .. } if is_logarithmic(technique) => {
            include_str!("techniques/evaluate_exponential_logarithmic.wgsl")
        }
        Technique::Esm { .. } => include_str!("techniques/evaluate_exponential.wgsl"),
        Technique::Vsm => include_str!("techniques/evaluate_variance.wgsl"),
        Technique::Evsm2 { .. } | Technique::Evsm4 { .. } => {
            include_str!("techniques/evaluate_exponential_variance.wgsl")
        }
        Technique::Lvsm { .. } => include_str!("techniques/evaluate_layered_variance.wgsl"),
        Technique::Convolution { .. } => include_str!("techniques/evaluate_convolution.wgsl"),
        Technique::Hausdorff4 => include_str!("techniques/evaluate_hausdorff4.wgsl"),
        Technique::Hamburger6 => include_str!("techniques/evaluate_hamburger6.wgsl"),
        _ => include_str!("techniques/evaluate_hamburger4.wgsl"),
    };
    let map = match technique {
        Technique::Pcf(PcfTaps::Hardware { .. }) => {
            include_str!("techniques/map_depth_compared.wgsl")
        }
        _ if technique.reads_depth() => include_str!("techniques/map_depth.wgsl"),
        _ => include_str!("techniques/map_filterable.wgsl"),
    };
    vec![
        ("technique", text),
        ("technique_map", map),
        (
            "technique_receiver",
            include_str!("techniques/receiver.wgsl"),
        ),
        ("map_texel", include_str!("techniques/map_texel.wgsl")),
        ("technique_layers", layers(technique, false)),
    ]
}

/// Where the layers of a layered variance shadow map lie: `technique_layers`, in a pass for one layer of the map or for all.
pub(super) fn layers(technique: &Technique, one_layer: bool) -> &'static str {
    if !places_layers(technique) {
        include_str!("techniques/layers_known.wgsl")
    } else if one_layer {
        include_str!("techniques/layers_placed_one.wgsl")
    } else {
        include_str!("techniques/layers_placed.wgsl")
    }
}

/// Whether the splits come from the input [`SPLITS`].
pub(super) fn places_layers(technique: &Technique) -> bool {
    matches!(
        technique,
        Technique::Lvsm {
            splits: LayerSplits::Lloyd,
            ..
        }
    )
}

/// The input for the splits, and its binding.
pub(super) fn splits_input(one_layer: bool) -> (Slot, Binding) {
    let rule = TextureRule::new(moment_shadows::TextureFormat::Rgba32Float)
        .extent([2, 1])
        .layers(CountRule::Any);
    let slot = Slot::input(SPLITS, "Where the layers of the technique lie.", rule);
    let bound = if one_layer { bind::layer } else { bind::layers };
    let binding = Binding::new("splits_map", bound(SPLITS));
    (slot, binding)
}

/// Storage texture (of maps that are not drawn), storage and what else the shaders of a map's filters import.
pub(super) fn specialize_map(
    mut specialization: Specialization,
    encoding: &MapEncoding,
) -> Specialization {
    let storage = encoding.storage();
    if !storage.is_drawn() {
        let texture = format!("texture_storage_2d<{}, write>", encoding.format());
        specialization = specialization.alias("MomentsStorage", &texture);
    }
    let specialization = specialization.constant("STORAGE", &format!("{}u", storage.wgsl_index()));
    specialize(specialization, encoding.technique())
}

/// A technique's error at a node.
pub(super) fn property(error: impl core::fmt::Display) -> GraphError {
    GraphError::new(GraphErrorKind::Property, error.to_string())
}
