//! Variance shadow maps (Donnelly & Lauritzen, i3D 2006).

use super::row::{Encoding, LINEAR, Row};
use crate::Storage::{Float16, Float32, Unorm16};

const ENCODING: Encoding = Encoding {
    channels: "two_moments_from_depth(z)",
    texel: "two_moments_to_texel(mean, STORAGE)",
    ..LINEAR
};

const EVALUATION: &str = "return chebyshev_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE);";

const SOFT: &str = "let variance = summed_area_encoding_smallest_variance(TABLE_ERROR);
    return moment_soft_shadows_variance_intensity(table_sums, soft_table(receiver), variance, soft_receiver(receiver), receiver.light);";

pub(super) fn row() -> Row {
    let storages = &[Unorm16, Float32, Float16];
    Row {
        bounded_channels: true,
        has_table: true,
        soft: Some(SOFT),
        ..Row::of_map("vsm", storages, 2, ENCODING, EVALUATION)
    }
}
