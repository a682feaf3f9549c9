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

/// With the positive warp alone: the negative one is not stored.
pub(super) fn row_of_one(exponent: Finite) -> Row {
    row("evsm2", 2, [exponent.get(), 0.0], vec![exponent])
}

/// With both warps.
pub(super) fn row_of_both(positive: Finite, negative: Finite) -> Row {
    let exponents = vec![positive, negative];
    row("evsm4", 4, [positive.get(), negative.get()], exponents)
}

fn row(name: &'static str, channels: u32, of_warps: [f32; 2], exponents: Vec<Finite>) -> Row {
    let [positive, negative] = of_warps;
    Row {
        constants: vec![
            Constant::of_map("EXPONENTS", format!("vec2f({positive:?}, {negative:?})")),
            Constant::of_evaluation("BOTH_WARPS", exponents.len() == 2),
        ],
        exponents,
        largest_exponents: &[
            EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT32,
            EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT16,
        ],
        ..Row::of_map(name, &[Float32, Float16], channels, ENCODING, EVALUATION)
    }
}
