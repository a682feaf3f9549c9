//! Layered variance shadow maps (Lauritzen & McCool, GI 2008).

use super::row::{Constant, Encoding, LINEAR, Row, float, vec4};
use super::vsm::far_of_pairs;
use super::{Finite, LayerSplits, count, far, setting};
use crate::Storage::{Float16, Float32, Unorm16};
use crate::ValueError;
use crate::constants::LAYERED_VARIANCE_LARGEST_COUNT;

const NAME: &str = "lvsm";

const ENCODING: Encoding = Encoding {
    channels: "layered_variance_channels(z, technique_layers(0u), PLANE)",
    texel: "two_moments_to_texel(mean, STORAGE)",
    ..LINEAR
};

const EVALUATION: &str = "let layers = technique_layers(receiver.layer);
    let last = layered_variance_last_layer(layers, receiver.fragment_depth);
    var intensity = 0.0;
    for (var plane = 0u; plane <= last / 2u; plane++) {
        let texel = map_texel(receiver, plane);
        intensity = max(intensity, layered_variance_shadow_intensity_of_plane(texel, receiver.fragment_depth, STORAGE, layers, plane));
    }
    return intensity;";

const LAYER: &str = "return layered_variance_last_layer(technique_layers(receiver.layer), receiver.fragment_depth);";

pub(super) fn row(layers: u32, overlap: Finite, splits: &LayerSplits) -> Row {
    let storages = &[Unorm16, Float32, Float16];
    let known = splits.known(layers);
    let mut constants = vec![
        Constant::of_map("LAYERS", format!("{layers}u")),
        Constant::of_map("LAYER_OVERLAP", float(overlap.get())),
    ];
    constants.extend(known.iter().flat_map(|known| of_splits(known)));
    Row {
        planes: layers.div_ceil(2),
        settings: check(layers, overlap, splits),
        constants,
        places_layers: known.is_none(),
        bounded_channels: true,
        layer: Some(LAYER),
        // Every layer ends before the far end, or there.
        far: far::of_each(storages, |storage| {
            far_of_pairs(storage, layers.next_multiple_of(2))
        }),
        ..Row::of_map(NAME, storages, 4, ENCODING, EVALUATION)
    }
}

/// The splits in two vectors; missing ones are at the far end.
fn of_splits(known: &[f32]) -> [Constant; 2] {
    [
        Constant::of_map("LAYER_SPLITS_LOW", vec4(known, 0, 1.0)),
        Constant::of_map("LAYER_SPLITS_HIGH", vec4(known, 4, 1.0)),
    ]
}

fn check(layers: u32, overlap: Finite, splits: &LayerSplits) -> Result<(), ValueError> {
    count(NAME, "layers", layers, LAYERED_VARIANCE_LARGEST_COUNT)?;
    let valid = (0.0..=0.5).contains(&overlap.get());
    setting(valid, NAME, "overlap", overlap, "from 0 to 0.5")?;
    let LayerSplits::Given(given) = splits else {
        return Ok(());
    };
    let places: Vec<f32> = core::iter::once(-1.0)
        .chain(given.iter().map(|split| split.get()))
        .chain([1.0])
        .collect();
    // Layers that are narrower than their overlap would contain others.
    let apart = |pair: &[f32]| pair[1] - pair[0] > overlap.get();
    if given.len() + 1 == layers as usize && places.windows(2).all(apart) {
        return Ok(());
    }
    let message = format!(
        "the splits of {layers} layers are {} ascending moment depths between -1 and 1, all but the overlap apart; these {} are \
         not",
        layers - 1,
        given.len()
    );
    Err(ValueError::new("splits", message))
}
