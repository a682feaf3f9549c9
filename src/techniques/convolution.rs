//! Convolution shadow maps (Annen et al., EGSR 2007).

use core::f64::consts::PI;

use super::row::{Constant, Encoding, LINEAR, Row};
use super::{count, far};
use crate::Storage::{
    self, Fixed32, Float16, Float32, Packed32, Packed64, Unorm8, Unorm10, Unorm16,
};
use crate::constants::{CONVOLUTION_BOUNDS, CONVOLUTION_LARGEST_TERMS};

const NAME: &str = "convolution";

const ENCODING: Encoding = Encoding {
    channels: "convolution_channels(z, PLANE, TERMS)",
    texel: "convolution_to_texel(mean, STORAGE)",
    ..LINEAR
};

const EVALUATION: &str = "let place = convolution_receiver(receiver.fragment_depth, TERMS, LOWER_BOUND);
    var sum = 0.0;
    for (var plane = 0u; plane < PLANES; plane++) {
        sum += convolution_plane(map_texel(receiver, plane), STORAGE, plane, TERMS, place, CONVOLUTION_DAMPING);
    }
    return convolution_shadow_intensity(sum, TERMS, LOWER_BOUND);";

pub(super) fn row(terms: u32, lower_bound: bool) -> Row {
    let storages = &[Unorm8, Unorm16, Float16];
    Row {
        far: far::of_each(storages, |storage| far(storage, terms)),
        planes: terms.div_ceil(2),
        settings: count(NAME, "terms", terms, CONVOLUTION_LARGEST_TERMS),
        constants: vec![
            Constant::of_map("TERMS", format!("{terms}u")),
            Constant::of_evaluation("LOWER_BOUND", lower_bound),
        ],
        ..Row::of_map(NAME, storages, 4, ENCODING, EVALUATION)
    }
}

/// Sines and cosines of the far end, which lies two shifts before the end of the axis.
fn far(storage: Storage, terms: u32) -> Vec<[f64; 4]> {
    let terms = terms.clamp(1, CONVOLUTION_LARGEST_TERMS);
    let shift = CONVOLUTION_BOUNDS.get(2 * (terms as usize - 1)).copied();
    let place = 1.0 - 2.0 * f64::from(shift.unwrap_or_default());
    let planes = (0..terms.div_ceil(2)).map(|plane| {
        let [first, second] = [1, 3].map(|odd| PI * f64::from(4 * plane + odd) * place);
        let waves = [first.sin(), first.cos(), second.sin(), second.cos()];
        match storage {
            Float16 => waves,
            Unorm8 | Unorm10 | Unorm16 | Float32 | Fixed32 | Packed64 | Packed32 => {
                waves.map(|wave| 0.5 + 0.5 * wave)
            }
        }
    });
    planes.collect()
}
