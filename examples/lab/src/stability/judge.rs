//! The judge: what a technique's results are worth, given the truths.

use serde::{Deserialize, Serialize};

use super::input::Input;
use super::strata::Stratum;

/// Bins of the histogram of excesses per power of ten.
const BINS_PER_DECADE: f64 = 64.0;

/// Excesses below this count as none.
const SMALLEST_EXCESS: f64 = 1e-12;

/// Bins up to an excess of 1.
const BINS: usize = 12 * BINS_PER_DECADE as usize;

/// Inputs that a stratum keeps to climb from.
const KEPT: usize = 10;

/// An input whose truth is known, and what a technique made of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Case {
    /// The input.
    pub input: Input,
    /// The share of surfaces in front of the fragment.
    pub truth: f64,
    /// The technique's shadow intensity.
    pub found: f32,
}

impl Case {
    /// The shadow intensity beyond the truth; negative where light leaks.
    #[must_use]
    pub fn excess(&self) -> f64 {
        f64::from(self.found) - self.truth
    }
}

/// An input whose result is not a shadow intensity.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Fault {
    /// The input.
    pub input: Input,
    /// The bits of the result.
    found: u32,
}

impl Fault {
    /// The result.
    #[must_use]
    pub fn found(&self) -> f32 {
        f32::from_bits(self.found)
    }
}

/// What a stratum showed.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct StratumTally {
    /// Inputs.
    pub samples: u64,
    /// Results that are NaN or infinite.
    pub not_finite: u64,
    /// Finite results outside [0, 1].
    pub outside: u64,
    /// The worst cases, the greatest excess first.
    pub worst: Vec<Case>,
}

/// Counts over many results of one technique with one storage.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Tally {
    /// Counts by stratum, in the order of [`Stratum::ALL`].
    pub strata: Vec<StratumTally>,
    /// Results with a truth.
    pub judged: u64,
    /// The first result that is not a shadow intensity.
    pub first_fault: Option<Fault>,
    leak: f64,
    /// Excesses: none, then by their logarithm.
    histogram: Vec<u64>,
}

/// A quantile of the excess.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Quantile {
    /// The share of results that are not beyond.
    pub share: f64,
    /// The excess, rounded up by 4 % at most.
    pub excess: f64,
}

impl Default for Tally {
    fn default() -> Self {
        Self {
            strata: vec![StratumTally::default(); Stratum::ALL.len()],
            judged: 0,
            first_fault: None,
            leak: 0.0,
            histogram: vec![0; BINS + 1],
        }
    }
}

impl Tally {
    /// Counts a result. Without a truth it only has to be a shadow intensity.
    pub fn add(&mut self, stratum: Stratum, input: &Input, truth: Option<f64>, found: f32) {
        let tally = &mut self.strata[stratum as usize];
        tally.samples += 1;
        let fault = !(0.0..=1.0).contains(&found);
        if fault {
            if found.is_finite() {
                tally.outside += 1;
            } else {
                tally.not_finite += 1;
            }
            self.first_fault.get_or_insert(Fault {
                input: *input,
                found: found.to_bits(),
            });
        }
        let Some(truth) = truth else { return };
        self.judged += 1;
        let case = Case {
            input: *input,
            truth,
            found,
        };
        let excess = case.excess();
        self.histogram[bin(excess)] += 1;
        if !excess.is_finite() {
            // Counted above; there is nothing to compare or to climb from.
            return;
        }
        self.leak += (-excess).max(0.0);
        let least = tally.worst.last().map_or(f64::MIN, Case::excess);
        if tally.worst.len() < KEPT || excess > least {
            let place = tally.worst.partition_point(|kept| kept.excess() >= excess);
            tally.worst.insert(place, case);
            tally.worst.truncate(KEPT);
        }
    }

    /// Whether it has the strata and bins of this build, as one from a file may not.
    pub(super) fn is_whole(&self) -> bool {
        self.strata.len() == Stratum::ALL.len() && self.histogram.len() == BINS + 1
    }

    /// Results.
    #[must_use]
    pub fn samples(&self) -> u64 {
        self.strata.iter().map(|tally| tally.samples).sum()
    }

    /// Results that are NaN or infinite.
    #[must_use]
    pub fn not_finite(&self) -> u64 {
        self.strata.iter().map(|tally| tally.not_finite).sum()
    }

    /// Finite results outside [0, 1].
    #[must_use]
    pub fn outside(&self) -> u64 {
        self.strata.iter().map(|tally| tally.outside).sum()
    }

    /// The mean over all truths of what is missing to them.
    #[must_use]
    pub fn mean_leak(&self) -> f64 {
        self.leak / self.judged.max(1) as f64
    }

    /// The case with the greatest excess, and its stratum.
    #[must_use]
    pub fn worst(&self) -> Option<(Stratum, Case)> {
        Stratum::ALL
            .into_iter()
            .zip(&self.strata)
            .filter_map(|(stratum, tally)| Some((stratum, *tally.worst.first()?)))
            .max_by(|a, b| a.1.excess().total_cmp(&b.1.excess()))
    }

    /// The excess that a share of the results does not exceed.
    #[must_use]
    pub fn quantile(&self, share: f64) -> Quantile {
        let rank = (share * self.judged as f64).ceil() as u64;
        let mut below = 0;
        let bin = self.histogram.iter().position(|count| {
            below += count;
            below >= rank
        });
        let excess = match bin {
            None | Some(0) => 0.0,
            Some(bin) => SMALLEST_EXCESS * 10.0_f64.powf(bin as f64 / BINS_PER_DECADE),
        };
        Quantile { share, excess }
    }
}

fn bin(excess: f64) -> usize {
    if excess.is_nan() || excess <= SMALLEST_EXCESS {
        return 0;
    }
    let place = (excess / SMALLEST_EXCESS).log10() * BINS_PER_DECADE;
    (place.ceil() as usize).clamp(1, BINS)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;

    fn tally(results: &[(Option<f64>, f32)]) -> Tally {
        let mut tally = Tally::default();
        for &(truth, found) in results {
            tally.add(Stratum::Diracs, &Input::default(), truth, found);
        }
        tally
    }

    #[test]
    fn results_that_are_no_shadow_intensities_are_counted_and_the_first_is_kept() {
        let tally = tally(&[
            (Some(0.5), 0.5),
            (None, 1.0_f32.next_up()),
            (None, f32::NAN),
            (Some(0.5), f32::INFINITY),
            (None, -1e-30),
            (None, -0.0),
        ]);
        assert_eq!([tally.not_finite(), tally.outside()], [2, 2]);
        assert_eq!(tally.first_fault.unwrap().found(), 1.0_f32.next_up());
        assert_eq!([tally.samples(), tally.judged], [6, 2]);
    }

    #[test]
    fn excess_leak_and_quantiles_are_those_of_the_results() {
        let mut results = vec![(Some(0.5), 0.25); 990];
        results.extend([(Some(0.5), 0.75); 10]);
        let tally = tally(&results);
        assert_eq!(tally.worst().unwrap().1.excess(), 0.25);
        assert!((tally.mean_leak() - 0.99 * 0.25).abs() < 1e-12);
        assert_eq!(tally.quantile(0.98).excess, 0.0);
        let high = tally.quantile(0.999).excess;
        // A bin is a 64th of a power of ten wide.
        assert!((0.25..=0.26).contains(&high), "{high}");
    }
}
