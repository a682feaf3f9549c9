//! Exponential variance shadow maps (Lauritzen & McCool, GI 2008), with one warp or both.

use super::row::{Constant, Encoding, LINEAR, Row};
use super::{Finite, far};
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

/// With the positive warp alone.
pub(super) fn evsm2(exponent: Option<Finite>) -> Row {
    row("evsm2", 2, [exponent, None], false)
}

/// With both warps.
pub(super) fn evsm4(positive: Option<Finite>, negative: Option<Finite>) -> Row {
    row("evsm4", 4, [positive, negative], true)
}

fn row(name: &'static str, channels: u32, exponents: [Option<Finite>; 2], both: bool) -> Row {
    let storages = &[Float32, Float16];
    let [x, y] = exponents.map(|exponent| exponent.unwrap_or_default().get());
    let [positive, negative] = [x, -y].map(|exponent| f64::from(exponent).exp());
    let [positive, negative] = [positive, -negative].map(|warp| [warp, warp * warp]);
    let second = if both { negative } else { [0.0; 2] };
    let far = [positive[0], positive[1], second[0], second[1]];
    Row {
        far: far::of_each(storages, |_| vec![far]),
        constants: vec![
            Constant::of_map("EXPONENTS", format!("vec2f({x:?}, {y:?})")),
            Constant::of_evaluation("BOTH_WARPS", both),
        ],
        exponents: exponents.into_iter().flatten().collect(),
        largest_exponents: &[
            EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT32,
            EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT16,
        ],
        ..Row::of_map(name, storages, channels, ENCODING, EVALUATION)
    }
}
