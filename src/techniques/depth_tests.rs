//! Tests on the plain depth map: `binary`, `pcf`, `pcss`.

use core::fmt::Display;

use super::row::{Constant, Row, float, vec4};
use super::{Finite, PcfTaps, count, setting};
use crate::constants::{
    PERCENTAGE_CLOSER_LARGEST_DISK as LARGEST_DISK, PERCENTAGE_CLOSER_SOFT_MOST_TAPS as MOST_TAPS,
};
use crate::{Kernel, ValueError};

const LARGEST_RADIUS: u32 = Kernel::LARGEST_RADIUS;

/// The comparison with the nearest texel (Williams, SIGGRAPH 1978).
pub(super) fn binary() -> Row {
    let evaluation = "return percentage_closer_binary(depth_map, receiver.layer, receiver.region, plane, receiver.conversion);";
    Row::of_depth("binary", evaluation)
}

/// Percentage-closer soft shadows: a filter as wide as the penumbra (Fernando, SIGGRAPH 2005).
pub(super) fn pcss(search_taps: u32, filter_taps: u32) -> Row {
    const NAME: &str = "pcss";
    let evaluation = "return percentage_closer_soft_intensity(depth_map, receiver.layer, receiver.region, plane, receiver.conversion, receiver.light, SEARCH_TAPS, FILTER_TAPS, disk_samples_angle(receiver.pixel));";
    let blockers = "let rotation = disk_samples_rotation(disk_samples_angle(receiver.pixel));
    let radius = area_light_disk(receiver.light, -1.0, plane.depth);
    let blockers = percentage_closer_soft_search(depth_map, receiver.layer, receiver.region, plane, receiver.conversion, radius, SEARCH_TAPS, rotation);
    let half_extent = area_light_disk(receiver.light, blockers.depth, plane.depth);
    return vec3f(blockers.share, blockers.depth, max(half_extent.x, half_extent.y));";
    Row {
        blockers: Some(blockers),
        settings: count(NAME, "search taps", search_taps, MOST_TAPS)
            .and_then(|()| count(NAME, "filter taps", filter_taps, MOST_TAPS)),
        constants: vec![
            Constant::of_evaluation("SEARCH_TAPS", format!("{search_taps}u")),
            Constant::of_evaluation("FILTER_TAPS", format!("{filter_taps}u")),
        ],
        ..Row::of_depth(NAME, evaluation)
    }
}

const PCF: &str = "pcf";

const BOX: &str = "return percentage_closer_box(depth_map, receiver.layer, receiver.region, plane, receiver.conversion, RADIUS);";

const GAUSSIAN: &str = "return percentage_closer_gaussian(depth_map, receiver.layer, receiver.region, plane, receiver.conversion, RADIUS, SIGMA);";

const WEIGHTS: &str = "return percentage_closer_kernel(depth_map, receiver.layer, receiver.region, plane, receiver.conversion, PercentageCloserKernel(u32(RADIUS), KERNEL_WEIGHTS));";

const POISSON: &str = "return percentage_closer_poisson(depth_map, receiver.layer, receiver.region, plane, receiver.conversion, DISK_RADIUS, disk_samples_angle(receiver.pixel));";

const HARDWARE: &str = "return percentage_closer_hardware_box(depth_map, comparison_sampler, receiver.layer, receiver.region, plane, receiver.conversion, RADIUS);";

/// Percentage-closer filtering: the mean of comparisons (Reeves, Salesin & Cook, SIGGRAPH 1987).
pub(super) fn pcf(taps: &PcfTaps) -> Row {
    let radius_constant = |radius: u32| Constant::of_evaluation("RADIUS", format!("{radius}i"));
    let of_square = |radius: u32| check_radius(radius, LARGEST_RADIUS);
    let row = |settings, evaluation, constants| Row {
        settings,
        constants,
        ..Row::of_depth(PCF, evaluation)
    };
    match taps {
        PcfTaps::Box { radius } => row(of_square(*radius), BOX, vec![radius_constant(*radius)]),
        PcfTaps::Gaussian { radius, sigma } => row(
            of_square(*radius).and_then(|()| check_sigma(*sigma)),
            GAUSSIAN,
            vec![
                radius_constant(*radius),
                Constant::of_evaluation("SIGMA", float(sigma.get())),
            ],
        ),
        PcfTaps::Weights(weights) => row(
            check_weights(weights),
            WEIGHTS,
            vec![
                radius_constant((weights.len() / 2) as u32),
                Constant::of_evaluation("KERNEL_WEIGHTS", weight_vectors(weights)),
            ],
        ),
        PcfTaps::Poisson { radius } => row(
            check_radius(radius.get(), LARGEST_DISK),
            POISSON,
            vec![Constant::of_evaluation("DISK_RADIUS", float(radius.get()))],
        ),
        PcfTaps::Hardware { radius, reversed } => Row {
            comparison: Some(*reversed),
            ..row(of_square(*radius), HARDWARE, vec![radius_constant(*radius)])
        },
    }
}

/// The weights as WGSL has them, followed by zeros.
fn weight_vectors(weights: &[Finite]) -> String {
    let weights: Vec<f32> = weights.iter().map(|weight| weight.get()).collect();
    let vectors = (2 * LARGEST_RADIUS as usize + 1).div_ceil(4);
    let all: Vec<String> = (0..vectors).map(|at| vec4(&weights, 4 * at, 0.0)).collect();
    format!("array<vec4f, {vectors}>({})", all.join(", "))
}

fn check_radius<T>(radius: T, largest: T) -> Result<(), ValueError>
where
    T: Copy + Default + Display + PartialOrd,
{
    let valid = (T::default()..=largest).contains(&radius);
    let legal = format!("from 0 to {largest} texels");
    setting(valid, PCF, "radius", radius, &legal)
}

fn check_sigma(sigma: Finite) -> Result<(), ValueError> {
    setting(
        sigma > Finite::ZERO,
        PCF,
        "standard deviation",
        sigma,
        "positive",
    )
}

fn check_weights(weights: &[Finite]) -> Result<(), ValueError> {
    let most = 2 * LARGEST_RADIUS as usize + 1;
    let odd = weights.len() % 2 == 1 && weights.len() <= most;
    let negative = weights.iter().any(|weight| *weight < Finite::ZERO);
    let sum: f32 = weights.iter().map(|weight| weight.get()).sum();
    if odd && !negative && sum > 0.0 && sum.is_finite() {
        return Ok(());
    }
    let message = format!(
        "{} weights are no filter: an odd number from 1 to {most} is, none of them negative and not all of them zero",
        weights.len()
    );
    Err(ValueError::new("weights", message))
}
