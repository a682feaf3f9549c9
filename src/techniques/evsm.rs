//! Exponential variance shadow maps (Lauritzen & McCool, GI 2008), with one warp or both.

use super::Finite;
use super::row::{Constant, Encoding, LINEAR, Row};
use crate::Storage::{Float16, Float32};
use crate::constants::{
    EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT16, EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT32,
};

const ENCODING: Encoding = Encoding {
    channels: "exponential_variance_channels(z, EXPONENTS)",
    texel: "exponential_variance_to_texel(mean, STORAGE)",
    ..LINEAR
};

const EVALUATION: &str = "return exponential_variance_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE, EXPONENTS, BOTH_WARPS);";

/// With the positive warp alone or with both.
pub(super) fn row(positive: Finite, negative: Option<Finite>) -> Row {
    let (name, channels) = negative.map_or(("evsm2", 2), |_| ("evsm4", 4));
    let [x, y] = [positive, negative.unwrap_or_default()].map(Finite::get);
    Row {
        constants: vec![
            Constant::of_map("EXPONENTS", format!("vec2f({x:?}, {y:?})")),
            Constant::of_evaluation("BOTH_WARPS", negative.is_some()),
        ],
        exponents: core::iter::once(positive).chain(negative).collect(),
        largest_exponents: &[
            EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT32,
            EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT16,
        ],
        ..Row::of_map(name, &[Float32, Float16], channels, ENCODING, EVALUATION)
    }
}
