//! Median and spread.

use serde::{Deserialize, Serialize};

/// Beyond this interquartile range, as a part of the median, a figure is marked unreliable.
pub const LARGEST_SPREAD: f64 = 0.15;

/// The distribution of a figure over the rounds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Distribution {
    /// The median.
    pub median: f64,
    /// The interquartile range, in the figure's own unit.
    pub interquartile_range: f64,
}

impl Distribution {
    /// The distribution of some figures; all NaN without figures. Quantiles between two figures are interpolated.
    #[must_use]
    pub fn of(figures: impl IntoIterator<Item = f64>) -> Self {
        let mut sorted: Vec<f64> = figures.into_iter().collect();
        sorted.sort_by(f64::total_cmp);
        Self {
            median: quantile(&sorted, 0.5),
            interquartile_range: quantile(&sorted, 0.75) - quantile(&sorted, 0.25),
        }
    }

    /// The distribution of the figures times a factor above 0.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        Self {
            median: factor * self.median,
            interquartile_range: factor * self.interquartile_range,
        }
    }

    /// The interquartile range as a part of the median.
    #[must_use]
    pub fn spread(self) -> f64 {
        self.interquartile_range / self.median
    }

    /// Whether the spread is small enough to judge by the median.
    #[must_use]
    pub fn reliable(self) -> bool {
        self.spread() <= LARGEST_SPREAD
    }
}

/// The quantile of ascending figures, linear between neighbours; NaN without figures.
fn quantile(sorted: &[f64], part: f64) -> f64 {
    let position = part * sorted.len().saturating_sub(1) as f64;
    let (below, above) = (position.floor() as usize, position.ceil() as usize);
    match (sorted.get(below), sorted.get(above)) {
        (Some(low), Some(high)) => low + (high - low) * position.fract(),
        _ => f64::NAN,
    }
}
