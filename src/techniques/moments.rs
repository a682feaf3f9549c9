//! Moment shadow mapping: `hamburger4`, `hausdorff4`, `hamburger6`.

use super::row::{Encoding, LINEAR, Row};
use crate::Storage::{self, Float16, Float32, Unorm10, Unorm16};

const FOUR: Encoding = Encoding {
    channels: "four_moments_from_depth(z)",
    texel: "four_moments_to_texel(mean, STORAGE)",
    ..LINEAR
};

/// The sharp lower bound from four moments on the real line (Peters & Klein, i3D 2015).
pub(super) fn hamburger4() -> Row {
    let evaluation = "return hamburger4_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE);";
    let soft = "let bias = summed_area_encoding_moment_bias(TABLE_ERROR);
    return moment_soft_shadows_intensity(table_sums, soft_table(receiver), bias, soft_receiver(receiver), receiver.light);";
    Row {
        soft: Some(soft),
        both_bounds: true,
        ..of_four("hamburger4", evaluation)
    }
}

fn of_four(name: &'static str, evaluation: &'static str) -> Row {
    Row {
        bounded_channels: true,
        has_table: true,
        ..Row::of_map(name, &Storage::OF_FOUR_MOMENTS, 4, FOUR, evaluation)
    }
}

/// The sharp lower bound from four moments on the light's range (Peters & Klein, i3D 2015).
pub(super) fn hausdorff4() -> Row {
    let evaluation = "return hausdorff4_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE);";
    of_four("hausdorff4", evaluation)
}

const SIX: Encoding = Encoding {
    channels: "six_moments_channels(z, PLANE)",
    texel: "six_moments_to_texel(mean, PLANE, STORAGE)",
    ..LINEAR
};

/// The sharp lower bound from six moments on the real line (Peters et al., JCGT 6(1) 2017).
pub(super) fn hamburger6() -> Row {
    let evaluation =
        "let texels = array<vec4f, 2>(map_texel(receiver, 0u), map_texel(receiver, 1u));
    return hamburger6_shadow_intensity_of_texels(texels, receiver.fragment_depth, STORAGE);";
    // The last is half as large as the others, but the one that leaks farthest.
    let storages = &[Unorm16, Float16, Float32, Unorm10];
    Row {
        planes: 2,
        bounded_channels: true,
        both_bounds: true,
        ..Row::of_map("hamburger6", storages, 4, SIX, evaluation)
    }
}
