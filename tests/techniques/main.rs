//! Each technique's WGSL on the adapter against truths in f64 that know nothing of it.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod convolution;
mod exponential;
mod exponential_variance;
mod filtering;
mod hausdorff;
mod hostile;
mod layered_variance;
mod lloyd;
mod lloyd_empty;
mod mixture;
mod variance;
#[path = "../support/wgsl_module.rs"]
mod wgsl_module;

/// 2^-24, half a unit in the last place of numbers just below 1.
const HALF_ULP: f64 = 1.0 / (1 << 24) as f64;

/// The one-sided Chebyshev bound for a variance and a distance from the mean.
fn chebyshev(variance: f64, distance: f64) -> f64 {
    let square = distance.max(0.0).powi(2);
    if square == 0.0 {
        0.0
    } else {
        square / (variance.max(0.0) + square)
    }
}

/// How the losses of variance by storage compare with what is added against them: the share that is greater than
/// `smallest`, and the share that is greater than a fifth of it. Both are asserted on.
fn assert_smallest(name: &str, mut losses: Vec<f64>, smallest: f64) {
    losses.sort_by(f64::total_cmp);
    let count = losses.len();
    let beyond = |limit: f64| losses.iter().filter(|&&loss| loss > limit).count();
    println!(
        "{name}: 99.9 % {:.2e}, 99.99 % {:.2e}, largest {:.2e}; smallest variance {smallest:.2e}",
        losses[count * 999 / 1000],
        losses[count * 9999 / 10000],
        losses[count - 1]
    );
    assert!(beyond(smallest) as f64 <= 1e-4 * count as f64, "{name}");
    // Not larger than it has to be, either.
    assert!(
        beyond(0.2 * smallest) as f64 > 1e-4 * count as f64,
        "{name}"
    );
}
