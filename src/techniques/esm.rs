//! Exponential shadow maps (Annen et al., GI 2008; Salvi 2008).

use super::row::{Constant, Encoding, LINEAR, Row, float};
use super::{EsmFiltering, Finite, far};
use crate::Storage::{Float16, Float32, Unorm16};
use crate::constants::{
    EXPONENTIAL_LARGEST_EXPONENT as LARGEST, EXPONENTIAL_LARGEST_EXPONENT_FLOAT16,
    EXPONENTIAL_LARGEST_EXPONENT_FLOAT16_LOGARITHMIC, EXPONENTIAL_LARGEST_EXPONENT_UNORM16,
    STORAGE_LARGEST_FLOAT16,
};

const NAME: &str = "esm";

const ENCODING: Encoding = Encoding {
    channels: "exponential_channels(z, EXPONENT)",
    texel: "exponential_to_texel(mean, STORAGE, EXPONENT, LOGARITHMIC)",
    ..LINEAR
};

/// Logarithms of means: a filter averages the means.
const LOGARITHMIC: Encoding = Encoding {
    filter_value: "vec4f(exponential_mean_of_texel(texel, STORAGE, EXPONENT, true), 0.0, 0.0, 0.0)",
    filter_texel: "exponential_to_texel(value, STORAGE, EXPONENT, true)",
    ..ENCODING
};

pub(super) fn row(exponent: Option<Finite>, filtering: EsmFiltering) -> Row {
    let row = match filtering {
        EsmFiltering::Linear => Row {
            largest_exponents: &[
                LARGEST,
                EXPONENTIAL_LARGEST_EXPONENT_FLOAT16,
                EXPONENTIAL_LARGEST_EXPONENT_UNORM16,
            ],
            ..Row::of_map(NAME, &[Float32, Float16, Unorm16], 1, ENCODING, EVALUATION)
        },
        EsmFiltering::Logarithmic => Row {
            averaged_by_samplers: false,
            exported: Some(EXPORTED_LOGARITHMIC),
            largest_exponents: &[
                LARGEST,
                LARGEST,
                EXPONENTIAL_LARGEST_EXPONENT_FLOAT16_LOGARITHMIC,
            ],
            ..Row::of_map(
                NAME,
                &[Unorm16, Float32, Float16],
                1,
                LOGARITHMIC,
                EVALUATION_LOGARITHMIC,
            )
        },
    };
    let largest = f64::from(exponent.unwrap_or_default().get()).exp();
    let far = far::of_each(row.storages, |storage| {
        let value = match filtering {
            EsmFiltering::Linear if storage == Float32 => largest,
            EsmFiltering::Linear if storage == Float16 => {
                largest.min(f64::from(STORAGE_LARGEST_FLOAT16))
            }
            EsmFiltering::Linear | EsmFiltering::Logarithmic => 1.0,
        };
        vec![[value, 0.0, 0.0, 0.0]]
    });
    Row {
        far,
        functions: &["exponential_mean_of_texel"],
        exponents: Vec::from_iter(exponent),
        constants: vec![
            Constant::of_map("EXPONENT", float(exponent.unwrap_or_default().get())),
            Constant::of_map("LOGARITHMIC", filtering == EsmFiltering::Logarithmic),
        ],
        ..row
    }
}

const EVALUATION: &str = "return exponential_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE, EXPONENT, false);";

/// Texels hold logarithms: they are decoded before they are blended.
const EVALUATION_LOGARITHMIC: &str = "let place = map_region_place(receiver.region, receiver.uv) - 0.5;
    let base = floor(place);
    let weight = place - base;
    let low = vec2i(base);
    let high = min(low + 1, vec2i(receiver.region.origin + receiver.region.extent) - 1);
    let top_left = exponential_mean_of_texel(textureLoad(moments_map, low, receiver.layer, 0), STORAGE, EXPONENT, true);
    let top_right = exponential_mean_of_texel(textureLoad(moments_map, vec2i(high.x, low.y), receiver.layer, 0), STORAGE, EXPONENT, true);
    let bottom_left = exponential_mean_of_texel(textureLoad(moments_map, vec2i(low.x, high.y), receiver.layer, 0), STORAGE, EXPONENT, true);
    let bottom_right = exponential_mean_of_texel(textureLoad(moments_map, high, receiver.layer, 0), STORAGE, EXPONENT, true);
    let mean = mix(mix(top_left, top_right, weight.x), mix(bottom_left, bottom_right, weight.x), weight.y);
    return exponential_shadow_intensity(mean, receiver.fragment_depth, EXPONENT, 0.0);";

/// What is looked up is the mean itself.
const EXPORTED_LOGARITHMIC: &str = "return exponential_shadow_intensity(map_texel(receiver, 0u).x, receiver.fragment_depth, EXPONENT, 0.0);";
