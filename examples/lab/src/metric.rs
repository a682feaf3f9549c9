//! How far a picture of shadow intensities is from the truth.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::error::LabError;
use crate::truth::check_length;

/// Truths between these two, both excluded, make up the penumbra band. It is not dilated: what a technique leaks into
/// the umbra around it is seen in the figures over all facing pixels.
pub const PENUMBRA: [f32; 2] = [0.01, 0.99];

/// Figures of the absolute error over a set of samples: pixels, or surfaces that a light's rays meet. An empty set has none: they
/// are NaN, `null` in JSON.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorFigures {
    /// How many samples the set has.
    pub samples: usize,
    /// Mean absolute error: `leaking + overdarkening`.
    pub mean_absolute: f64,
    /// The part of it where the estimate is too light.
    pub leaking: f64,
    /// The part of it where the estimate is too dark.
    pub overdarkening: f64,
    /// 95 % of the samples have at most this absolute error.
    pub percentile_95: f64,
    /// The largest absolute error.
    pub maximum: f64,
}

/// An estimate of shadow intensities against the truth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Comparison {
    /// Errors over the pixels whose surface faces the light.
    pub facing: ErrorFigures,
    /// Errors over those of the facing pixels that lie in the penumbra band.
    pub penumbra: ErrorFigures,
    /// Mean absolute error over all pixels of the picture, sky included.
    pub picture_mean_absolute: f64,
    /// Pixels of the whole picture whose estimate is NaN. Each counts as an error of 1, too dark.
    pub nan_pixels: usize,
}

/// How much larger the error of an estimate is than that of the exact bound on the same filtered depths: 0.25 means a
/// quarter more. `None` where the exact bound has no error that a ratio could be formed with.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Excess {
    /// Excess of the mean absolute error over facing pixels.
    pub error: Option<f64>,
    /// Excess of the leaking part of that error.
    pub leaking: Option<f64>,
}

/// Compares `estimate` with `truth`; `facing` tells which pixels show a surface that faces the light (normal times
/// direction to the light above 0). Sums run over the pixels in order, in f64: the same pictures give the same figures.
pub fn compare(estimate: &[f32], truth: &[f32], facing: &[bool]) -> Result<Comparison, LabError> {
    check_length("the estimate", estimate.len(), truth.len())?;
    check_length("the list of facing pixels", facing.len(), truth.len())?;
    let mut errors = Vec::new();
    let mut penumbra_errors = Vec::new();
    let (mut total, mut nan_pixels) = (0.0, 0);
    for ((&estimate, &truth), &facing) in estimate.iter().zip(truth).zip(facing) {
        nan_pixels += usize::from(estimate.is_nan());
        let error = signed_error(estimate, truth);
        total += error.abs();
        if facing {
            errors.push(error);
            if truth > PENUMBRA[0] && truth < PENUMBRA[1] {
                penumbra_errors.push(error);
            }
        }
    }
    Ok(Comparison {
        facing: figures(errors),
        penumbra: figures(penumbra_errors),
        picture_mean_absolute: total / truth.len().max(1) as f64,
        nan_pixels,
    })
}

/// The excess of `estimate` over `exact`, two comparisons with the same truth.
pub fn excess(estimate: &Comparison, exact: &Comparison) -> Excess {
    let ratio = |estimate: f64, exact: f64| (exact > 0.0).then(|| estimate / exact - 1.0);
    Excess {
        error: ratio(estimate.facing.mean_absolute, exact.facing.mean_absolute),
        leaking: ratio(estimate.facing.leaking, exact.facing.leaking),
    }
}

/// Estimate less truth; a NaN counts as an error of 1, too dark.
pub(crate) fn signed_error(estimate: f32, truth: f32) -> f64 {
    if estimate.is_nan() {
        1.0
    } else {
        f64::from(estimate) - f64::from(truth)
    }
}

/// Figures of signed errors, estimate less truth. Sums run over them in order.
pub(crate) fn figures(mut errors: Vec<f64>) -> ErrorFigures {
    if errors.is_empty() {
        return ErrorFigures {
            samples: 0,
            mean_absolute: f64::NAN,
            leaking: f64::NAN,
            overdarkening: f64::NAN,
            percentile_95: f64::NAN,
            maximum: f64::NAN,
        };
    }
    let samples = errors.len();
    let count = samples as f64;
    let leaking = errors.iter().map(|error| (-error).max(0.0)).sum::<f64>() / count;
    let overdarkening = errors.iter().map(|error| error.max(0.0)).sum::<f64>() / count;
    for error in &mut errors {
        *error = error.abs();
    }
    // The nearest rank: the least value that is not exceeded by 95 % of the samples.
    let rank = (errors.len() * 95).div_ceil(100).max(1) - 1;
    let (_, &mut percentile_95, above) = errors.select_nth_unstable_by(rank, f64::total_cmp);
    ErrorFigures {
        samples,
        mean_absolute: leaking + overdarkening,
        leaking,
        overdarkening,
        percentile_95,
        maximum: above.iter().copied().fold(percentile_95, f64::max),
    }
}

/// What stands for a figure over an empty set of pixels.
pub const NO_PIXEL: &str = "no pixel";

/// An error as text, the unit of all tables: percent of full shadow. `none` where it is NaN, over an empty set.
#[must_use]
pub fn percent(error: f64, none: &str) -> String {
    match error.is_nan() {
        true => none.to_owned(),
        false => format!("{:.3}", 100.0 * error),
    }
}

impl ErrorFigures {
    /// The number of samples and all figures in percent in columns, each after a space; `none` for those over an empty set.
    #[must_use]
    pub fn columns(&self, none: &str) -> String {
        let figures = [
            self.mean_absolute,
            self.leaking,
            self.overdarkening,
            self.percentile_95,
            self.maximum,
        ];
        let figures = figures.map(|value| percent(value, none));
        let cells = core::iter::once(self.samples.to_string()).chain(figures);
        cells.map(|cell| format!(" {cell:>10}")).collect()
    }
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "{:<9} {:>10} {:>10} {:>10} {:>10} {:>10} {:>10}",
            "percent", "pixels", "mean abs", "leaking", "too dark", "95 %", "maximum"
        )?;
        for (name, row) in [("facing", &self.facing), ("penumbra", &self.penumbra)] {
            writeln!(f, "{name:<9}{}", row.columns(NO_PIXEL))?;
        }
        write!(
            f,
            "whole picture: mean abs {:.3} %, NaN pixels {}",
            100.0 * self.picture_mean_absolute,
            self.nan_pixels
        )
    }
}

impl fmt::Display for Excess {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let excess = |ratio: Option<f64>| {
            ratio.map_or_else(
                || "undefined".to_owned(),
                |ratio| format!("{:+.1} %", 100.0 * ratio),
            )
        };
        write!(
            f,
            "excess over the exact bound: error {}, leaking {}",
            excess(self.error),
            excess(self.leaking)
        )
    }
}
