//! Random patches of depth as a filter sees them, rounded and exact.

#[path = "../support/patches.rs"]
mod support;

pub(crate) use support::{filtered, patch};

use support::Patch;

/// The weights and depths of all texels of a patch, exact; the weights sum to 1.
pub(crate) fn taps(depths: &Patch) -> impl Iterator<Item = (f64, f64)> {
    let weights = support::weights().map(f64::from);
    let sum: f64 = weights.iter().sum();
    depths.iter().zip(weights).flat_map(move |(row, down)| {
        let taps = row.iter().zip(weights);
        taps.map(move |(&depth, across)| (down * across / (sum * sum), depth))
    })
}

/// The exact variance of warped depth under the filter.
pub(crate) fn variance_of(depths: &Patch, warp: impl Fn(f64) -> f64) -> f64 {
    let mean: f64 = taps(depths)
        .map(|(weight, depth)| weight * warp(depth))
        .sum();
    taps(depths)
        .map(|(weight, depth)| weight * (warp(depth) - mean).powi(2))
        .sum()
}
