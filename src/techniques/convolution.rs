//! Convolution shadow maps (Annen et al., EGSR 2007).

use super::count;
use super::row::{Constant, Encoding, LINEAR, Row};
use crate::Storage::{Float16, Unorm8, Unorm16};
use crate::constants::CONVOLUTION_LARGEST_TERMS;

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
    Row {
        planes: terms.div_ceil(2),
        settings: count(NAME, "terms", terms, CONVOLUTION_LARGEST_TERMS),
        constants: vec![
            Constant::of_map("TERMS", format!("{terms}u")),
            Constant::of_evaluation("LOWER_BOUND", lower_bound),
        ],
        ..Row::of_map(NAME, &[Unorm8, Unorm16, Float16], 4, ENCODING, EVALUATION)
    }
}
