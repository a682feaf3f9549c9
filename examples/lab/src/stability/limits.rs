//! How far above the truth each technique may be in each storage: one table, derived from what its module documents.
//!
//! All bounds are exact in exact arithmetic. What is above the truth comes from rounding: in a resolve and both passes of a
//! blur, to the storage, and in the sums of f32. Each technique keeps a reserve against it: a moment bias, a smallest
//! variance, an exponent that its storage allows for. The cases of the table are what is left when all errors add up.
//!
//! | technique | unorm8, unorm16, float16 | float32 |
//! |---|---|---|
//! | `esm` | a relative error of the mean, `exponential` | the same |
//! | `vsm`, `lvsm`, `evsm2`, `evsm4` | a variance that is too small by a factor, `chebyshev` | the same |
//! | `convolution` | errors of sines and cosines, `convolution` | |
//! | `hamburger4`, `hausdorff4` | the moment bias, and roundings of the evaluation; packed ones: `packed_limits` | the same |
//! | `hamburger6` | the moment bias | the moment bias, and roundings of the evaluation |
//!
//! A sum of n products in f32 is off by up to n / 3 units of 2^-24, all on one side where equal weights meet equal depths,
//! which for 129 texels is ten times the reserve of float32 and of packed texels. So these moments are summed in two parts, and
//! the sums are as good as those of few texels. Warps have no fixed range, and are not: `evsm2` and
//! `evsm4` in float32 lose more under wider filters. In the other storages rounding is so much coarser that sums do not matter.

use moment_shadows::{EsmFiltering, MapEncoding, Storage, Technique};

use super::packed_limits;

/// Half a unit in the last place of float32 below 1, 2^-24 / 2 being what a rounding of a number in [1/2, 1) is off by.
const HALF_ULP: f64 = 1.0 / (1 << 25) as f64;

/// What the evaluation of four moments rounds at least: the eight units that `hamburger4_bounds` and `hausdorff4_bounds` state,
/// where the sensitivity is 0.
const FOUR_EVALUATED: f64 = 8.0 * 2.0 * HALF_ULP;

/// A resolve and both passes of a blur round.
pub(super) const STAGES: f64 = 3.0;

/// The most texels along a filter, narrow and wide.
const WIDTHS: [f64; 2] = [9.0, 129.0];

/// The excess over the truth that is allowed to a pair, for filters up to 9 texels wide or wider ones.
#[must_use]
pub fn allowed_excess(encoding: &MapEncoding, wide: bool) -> f64 {
    let storage = encoding.storage();
    let is_split = encoding.has_split_sums(WIDTHS[1] as u32 / 2);
    let sums = sums(wide && !is_split);
    match encoding.technique() {
        Technique::Esm {
            exponent,
            filtering,
        } => exponential(
            storage,
            f64::from(exponent.unwrap_or_default().get()),
            *filtering,
            sums,
        ),
        Technique::Vsm | Technique::Lvsm { .. } => {
            let (floor, step) = match storage {
                Storage::Unorm16 => (6e-5, 0.5 / 65535.0),
                // Channels are within one half.
                Storage::Float16 => (1e-3, 1.0 / f64::from(1 << 13)),
                _ => (5e-7, 0.0),
            };
            // The mean is twice its channel less something in unorm16 and float16.
            let [mean, square] = [2.0, 1.0].map(|factor| STAGES * factor * step + sums);
            chebyshev(floor, mean, square)
        }
        Technique::Evsm2 { .. } | Technique::Evsm4 { .. } => {
            // Relative to the warp and its mean square.
            let (floor, step) = match storage {
                Storage::Float16 => (2.2e-3, 1.0 / f64::from(1 << 11)),
                _ => (6e-7, 0.0),
            };
            let error = STAGES * step + sums;
            chebyshev(floor, error, error)
        }
        Technique::Convolution { terms, .. } => convolution(storage, *terms, sums),
        // Moments with rounding errors that the bias covers are those of a mixture of the surfaces with the share 1 - alpha
        // and of others with alpha, which may all be in front.
        Technique::Hausdorff4 => f64::from(storage.hausdorff_moment_bias().alpha) + FOUR_EVALUATED,
        Technique::Hamburger6 => {
            let bias = storage.six_moments_bias();
            six_moments(storage, bias.map_or(1.0, |bias| f64::from(bias.alpha)))
        }
        _ => {
            let alpha = f64::from(storage.moment_bias().alpha);
            alpha + FOUR_EVALUATED + packed_limits::rounding(storage)
        }
    }
}

/// The limit of six moments: the bias, and for the finest storage what the evaluation itself rounds. The bias leaves a surface a
/// deviation of sqrt(alpha), over which the bound rises from 0 to 1; some units in the last place of depth shift it by these over
/// that.
fn six_moments(storage: Storage, alpha: f64) -> f64 {
    match storage {
        Storage::Float32 => alpha + 16.0 * HALF_ULP / alpha.sqrt(),
        _ => alpha,
    }
}

/// The error of the sums of both passes for values up to 1: each of n additions is off by half a unit of the sum so far, which
/// grows evenly. Half of them have the unit of numbers in [1/2, 1), a quarter half that, and so on: 2/3 of it on average.
fn sums(wide: bool) -> f64 {
    2.0 * WIDTHS[usize::from(wide)] * HALF_ULP * 2.0 / 3.0
}

/// The limit of a bound x^2 / (1 + x^2), with x the distance over the standard deviation, whose reserve is the variance `floor`.
/// The variance is at worst floor where it is floor + loss: the bound then grows by (r - 1) / (r + 1) at most, with r^2 their
/// ratio. An error of the mean adds the steepest slope of the bound, 3 sqrt(3) / 8, times itself over the standard deviation.
fn chebyshev(floor: f64, mean: f64, square: f64) -> f64 {
    let loss = square + 2.0 * mean;
    let ratio = (1.0 + loss / floor).sqrt();
    (ratio - 1.0) / (ratio + 1.0) + 3.0 * 3.0_f64.sqrt() / 8.0 * mean / floor.sqrt()
}

/// The limit of 1 - mean / e^(c z): relative errors of the mean are those of the visibility, which is at most 1.
fn exponential(storage: Storage, c: f64, filtering: EsmFiltering, sums: f64) -> f64 {
    let rounding = match (storage, filtering) {
        // Absolute in a value that falls to e^(-2 c).
        (Storage::Unorm16, EsmFiltering::Linear) => 0.5 / 65535.0 * (2.0 * c).exp(),
        (Storage::Float16, EsmFiltering::Linear) => 1.0 / f64::from(1 << 11),
        // The rounding of a logarithm from -1 to 1, times c.
        (Storage::Unorm16, EsmFiltering::Logarithmic) => c / 65535.0,
        (Storage::Float16, EsmFiltering::Logarithmic) => c / f64::from(1 << 12),
        // A logarithm, a quotient and their rounding.
        (_, EsmFiltering::Logarithmic) => 8.0 * c * HALF_ULP,
        _ => 0.0,
    };
    // WGSL asks of exp(x) for 3 + 2 |x| units in the last place; surface and fragment have it, the log space in each stage.
    let warps = 2.0 * STAGES * (3.0 + 2.0 * c) * 2.0 * HALF_ULP;
    // Products with weights below 2^-126 e^c an adapter may flush to zero, of up to eight surfaces.
    let flushed = 8.0 * f64::from(f32::MIN_POSITIVE) * c.exp();
    (STAGES * rounding + warps + sums + flushed).exp_m1()
}

/// The limit of a sum of amplitudes times sin(a) C - cos(a) S: sqrt(2) times the error of C and S.
fn convolution(storage: Storage, terms: u32, sums: f64) -> f64 {
    let step = match storage {
        Storage::Unorm8 => 1.0 / 255.0,
        Storage::Unorm16 => 1.0 / 65535.0,
        _ => 1.0 / f64::from(1 << 12),
    };
    let count = f64::from(terms);
    let amplitudes: f64 = (1..=terms)
        .map(|k| {
            let k = f64::from(k);
            2.0 * (-(k / count).powi(2)).exp() / (core::f64::consts::PI * (2.0 * k - 1.0))
        })
        .sum();
    // WGSL asks of sines for 2^-11, which no adapter is known to need; they are good to some units of arguments up to pi.
    let sines = 80.0 * HALF_ULP;
    2.0_f64.sqrt() * amplitudes * (STAGES * step + sines + sums)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::techniques::{filterable, label};

    #[test]
    fn what_is_allowed_is_less_than_a_third_wherever_something_is_promised() {
        for pair in filterable() {
            let [narrow, wide] = [false, true].map(|wide| allowed_excess(&pair, wide));
            println!("{pair}: {narrow:.2e}, {wide:.2e}");
            assert!(0.0 < narrow && narrow <= wide && wide <= 1.0);
            let is_float32 = pair.storage() == Storage::Float32;
            if !is_float32 || label(pair.technique()).starts_with("esm") {
                assert!(wide < 1.0 / 3.0, "{pair}");
            }
        }
    }
}
