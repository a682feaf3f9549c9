//! Moment shadow mapping: `hamburger4`, `hausdorff4`, `hamburger6`.

use super::far;
use super::row::{Blended, Encoding, LINEAR, Row};
use crate::Storage::{self, Float16, Float32, Packed32, Packed64, Unorm8, Unorm10, Unorm16};
use crate::constants::{SIX_MOMENTS_EVEN_BASIS, SIX_MOMENTS_EVEN_OFFSET};

const FOUR: Encoding = Encoding {
    channels: "four_moments_from_depth(z)",
    texel: "four_moments_to_texel(mean, STORAGE)",
    filter_value: "four_moments_filter_value(texel, STORAGE)",
    filter_texel: "four_moments_filter_texel(value, STORAGE)",
};

/// Packed texels are valid on the real line alone, and make up for it: other storages come first, since samplers filter them.
const OF_THE_LINE: [Storage; 5] = [Unorm16, Float16, Float32, Packed64, Packed32];

/// The sharp lower bound from four moments on the real line (Peters & Klein, i3D 2015).
pub(super) fn hamburger4() -> Row {
    let evaluation = "return hamburger4_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE);";
    let soft = "let bias = summed_area_encoding_moment_bias(TABLE_ERROR);
    return moment_soft_shadows_intensity(table_sums, soft_table(receiver), bias, soft_receiver(receiver), receiver.light);";
    let blockers = "let bias = summed_area_encoding_moment_bias(TABLE_ERROR);
    let blockers = moment_soft_shadows_blockers(table_sums, soft_table(receiver), bias, soft_receiver(receiver), receiver.light);
    let half_extent = area_light_box(receiver.light, blockers.depth, receiver.depth);
    return vec3f(blockers.share, blockers.depth, max(half_extent.x, half_extent.y));";
    let blended = "let bias = translucent_casters_four_moments_bias(four_moments_bias_of(STORAGE), BLENDS);
    return hamburger4_shadow_intensity(four_moments_from_texel(map_texel(receiver, 0u), STORAGE), receiver.fragment_depth, bias);";
    let rounded_inwards = "let bias = four_moments_bias_rounded_inwards_of(STORAGE);
    let biased = four_moments_biased_from_texel(map_texel(receiver, 0u), STORAGE, bias);
    return hamburger4_lower_bound(biased, receiver.fragment_depth, bias.alpha);";
    Row {
        rounded_inwards: Some(rounded_inwards),
        soft: Some(soft),
        blockers: Some(blockers),
        blended: Some(Blended {
            alpha_is_free: false,
            evaluation: blended,
        }),
        both_bounds: true,
        functions: &[
            "four_moments_from_texel",
            "hamburger4_bounds",
            "hamburger4_shadow_intensity",
        ],
        ..of_four("hamburger4", &OF_THE_LINE, evaluation)
    }
}

fn of_four(name: &'static str, storages: &'static [Storage], evaluation: &'static str) -> Row {
    Row {
        bounded_channels: true,
        has_table: true,
        far: far::of_each(storages, far_of_four),
        ..Row::of_map(name, storages, 4, FOUR, evaluation)
    }
}

/// The sharp lower bound from four moments on the light's range (Peters & Klein, i3D 2015).
pub(super) fn hausdorff4() -> Row {
    let evaluation = "return hausdorff4_shadow_intensity_of_texel(map_texel(receiver, 0u), receiver.fragment_depth, STORAGE);";
    let blended = "let bias = translucent_casters_four_moments_bias(hausdorff4_bias_of(STORAGE), BLENDS);
    let moments = four_moments_from_texel(storage_finite_texel(map_texel(receiver, 0u), STORAGE), STORAGE);
    return hausdorff4_lower_bound(four_moments_apply_bias(four_moments_clamp(moments), bias), receiver.fragment_depth, bias.alpha);";
    Row {
        blended: Some(Blended {
            alpha_is_free: false,
            evaluation: blended,
        }),
        functions: &["four_moments_from_texel", "hausdorff4_bounds"],
        ..of_four("hausdorff4", &Storage::OF_FOUR_MOMENTS, evaluation)
    }
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
    let blended = "let bias = translucent_casters_six_moments_bias(six_moments_bias_of(STORAGE), BLENDS);
    let texels = array<vec4f, 2>(map_texel(receiver, 0u), map_texel(receiver, 1u));
    return hamburger6_shadow_intensity(six_moments_from_texels(texels, STORAGE), receiver.fragment_depth, bias);";
    // The last is half as large as the others, but the one that leaks farthest.
    let storages = &[Unorm16, Float16, Float32, Unorm10];
    let rectified = &[Unorm8];
    Row {
        planes: 2,
        rectified,
        blended: Some(Blended {
            alpha_is_free: true,
            evaluation: blended,
        }),
        bounded_channels: true,
        both_bounds: true,
        functions: &["six_moments_from_texels", "hamburger6_bounds"],
        far: far::of_each(&[&storages[..], &rectified[..]].concat(), far_of_six),
        ..Row::of_map("hamburger6", storages, 4, SIX, evaluation)
    }
}

/// All moments are 1: the ends of the ranges of five channels, and the sum of the sixth's row. The fourth channel is 1.
fn far_of_six(storage: Storage) -> Vec<[f64; 4]> {
    let row = SIX_MOMENTS_EVEN_BASIS.iter().skip(2).step_by(3);
    let last = SIX_MOMENTS_EVEN_OFFSET.last().into_iter().chain(row);
    let last = last.map(|&value| f64::from(value)).sum();
    let mut planes = far::centred(&[[1.0; 4], [0.0, 1.0, last, 1.0]], storage);
    planes.iter_mut().for_each(|plane| plane[3] = 1.0);
    planes
}

/// All moments are 1: 1/2 + sqrt(3) (1/2 - 2/9) in the third channel of the optimised basis.
fn far_of_four(storage: Storage) -> Vec<[f64; 4]> {
    if storage == Float32 || storage == Packed32 {
        return vec![[1.0; 4]];
    }
    if storage == Packed64 {
        // The upper depth has all the weight, and the lower one is a step below.
        return vec![[32766.0 / 32767.0, 1.0, 1.0, 0.0]];
    }
    let third = 0.5 + 3_f64.sqrt() * (0.5 - 2.0 / 9.0);
    far::centred(&[[0.0, 0.0, third, 1.0]], storage)
}
