//! The Fourier series of convolution shadow maps as a lower bound (Annen et al., "Convolution Shadow Maps", 2007).
//!
//! The step is a square wave of period 2 in depths u of [0, 1]: visibility at u = d is
//! 1/2 + 2 sum_k sin(c_k (u - d)) / c_k with c_k = pi (2k - 1). Term k is damped by e^(-a (k/M)^2) against ringing. A finite
//! series is 1/2 on the fragment itself and rings beyond, so it bounds nothing. Here it is shifted to where it has almost
//! vanished, depths are squeezed to keep clear of the next step of the wave, and its ringing is subtracted.

use core::f64::consts::PI;

use super::Surfaces;

/// Intervals per term on which extrema are looked for; the series has one extremum per half period of its last term.
const INTERVALS_PER_TERM: u32 = 64;

/// What is left of the series where it counts as vanished: a longer wait for less would shift it farther.
const ALMOST: f64 = 0.01;

/// A damped series that stays below the step.
#[derive(Clone, Debug, PartialEq)]
pub struct FourierSeries {
    /// (c_k, the factor of its sine).
    terms: Vec<(f64, f64)>,
    shift: f64,
    ringing: f64,
}

impl FourierSeries {
    /// A series of `terms` terms (at least 1), damped by e^(-`damping` (k / terms)^2).
    #[must_use]
    pub fn new(terms: u32, damping: f64) -> Self {
        let terms = terms.max(1);
        let mut series = Self {
            terms: (1..=terms)
                .map(|k| {
                    let frequency = PI * (2.0 * f64::from(k) - 1.0);
                    let part = f64::from(k) / f64::from(terms);
                    (frequency, 2.0 * (-damping * part * part).exp() / frequency)
                })
                .collect(),
            shift: 0.0,
            ringing: 0.0,
        };
        // Symmetric to 1/2, so that a quarter of the period shows all.
        let count = INTERVALS_PER_TERM * terms;
        let values: Vec<(f64, f64)> = (0..=count)
            .map(|index| 0.5 * f64::from(index) / f64::from(count))
            .map(|x| (x, series.shadow(x)))
            .collect();
        // Where it first almost vanishes, or is almost least if it does not.
        let least = values
            .iter()
            .map(|value| value.1)
            .fold(f64::INFINITY, f64::min);
        let vanishes = values
            .iter()
            .position(|value| value.1 <= least.max(0.0) + ALMOST);
        if let Some(first) = vanishes {
            series.shift = values[first].0;
            let ringing = values[first..]
                .iter()
                .map(|value| value.1.abs())
                .fold(0.0, f64::max);
            // Between samples an extremum is higher by at most an eighth of the curvature times the squared distance.
            let step = 0.5 / f64::from(count);
            let curvature: f64 = series.terms.iter().map(|(c, factor)| c * c * factor).sum();
            series.ringing = ringing + curvature * step * step / 8.0;
        }
        series
    }

    /// How many terms it has.
    #[must_use]
    pub fn terms(&self) -> usize {
        self.terms.len()
    }

    /// The plain series: the shadow intensity that a surface `distance` behind the fragment casts on it, for distances of
    /// depths in [0, 1]; 1/2 at 0, about 1 in front and about 0 behind.
    #[must_use]
    pub fn shadow(&self, distance: f64) -> f64 {
        0.5 - self
            .terms
            .iter()
            .map(|(c, factor)| factor * (c * distance).sin())
            .sum::<f64>()
    }

    pub(super) fn lower_bound(&self, surfaces: &Surfaces<'_>, fragment_depth: f64) -> f64 {
        let squeeze = 0.5 * (1.0 - 2.0 * self.shift).max(0.0);
        let shadow = surfaces.mean(|z| self.shadow(squeeze * (z - fragment_depth) + self.shift));
        (shadow - self.ringing).clamp(0.0, 1.0)
    }
}
