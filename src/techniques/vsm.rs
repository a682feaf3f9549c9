//! Variance shadow maps (Donnelly & Lauritzen, i3D 2006).

use super::far;
use super::row::{Blended, Encoding, LINEAR, Row};
use crate::Storage::{
    self, Fixed32, Float16, Float32, Packed32, Packed64, Unorm8, Unorm10, Unorm16,
};

const ENCODING: Encoding = Encoding {
    channels: "two_moments_from_depth(z)",
    texel: "two_moments_to_texel(mean, STORAGE)",
    ..LINEAR
};

const EVALUATION: &str = "return chebyshev_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE);";

const BLENDED: Blended = Blended {
    alpha_is_free: true,
    evaluation: "let variance = translucent_casters_smallest_variance(two_moments_smallest_variance_of(STORAGE), BLENDS);
    let moments = two_moments_from_texel(map_texel(receiver, 0u), STORAGE).xy;
    return chebyshev_lower_bound(moments, depth_of_fragment(receiver.fragment_depth), variance);",
};

const SOFT: &str = "let variance = summed_area_encoding_smallest_variance(TABLE_ERROR);
    return moment_soft_shadows_variance_intensity(table_sums, soft_table(receiver), variance, soft_receiver(receiver), receiver.light);";

const BLOCKERS: &str = "let variance = summed_area_encoding_smallest_variance(TABLE_ERROR);
    let blockers = moment_soft_shadows_variance_blockers(table_sums, soft_table(receiver), variance, soft_receiver(receiver), receiver.light);
    let half_extent = area_light_box(receiver.light, blockers.depth, receiver.depth);
    return vec3f(blockers.share, blockers.depth, max(half_extent.x, half_extent.y));";

pub(super) fn row() -> Row {
    let storages = &[Unorm16, Float32, Float16];
    Row {
        bounded_channels: true,
        has_table: true,
        soft: Some(SOFT),
        blockers: Some(BLOCKERS),
        blended: Some(BLENDED),
        functions: &["two_moments_from_texel", "chebyshev_upper_bound"],
        far: far::of_each(storages, |storage| far_of_pairs(storage, 1)),
        ..Row::of_map("vsm", storages, 2, ENCODING, EVALUATION)
    }
}

/// Pairs of moments that are 1, two to a texel; of a single one the others are zeros.
pub(super) fn far_of_pairs(storage: Storage, pairs: u32) -> Vec<[f64; 4]> {
    let pair = match storage {
        Float32 => [1.0, 1.0],
        Float16 => [0.5, -0.5],
        Unorm8 | Unorm10 | Unorm16 | Fixed32 | Packed64 | Packed32 => [1.0, 0.0],
    };
    let second = if pairs > 1 { pair } else { [0.0; 2] };
    let texel = [pair[0], pair[1], second[0], second[1]];
    vec![texel; pairs.div_ceil(2) as usize]
}
