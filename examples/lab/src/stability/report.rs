//! The report as a table.

use core::fmt;

use moment_shadows::{MapEncoding, Storage};
use serde::Serialize;

use super::Effort;
use super::input::Input;
use super::judge::{Case, Quantile, Tally};
use super::limits::allowed_excess;
use super::strata::Stratum;
use crate::techniques::label;

/// The shares of results that quantiles of the excess are given for.
pub const SHARES: [f64; 4] = [0.99, 0.999, 0.9999, 0.99999];

/// The report.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Report {
    /// The adapter's name.
    pub adapter: String,
    /// How much was tried.
    pub effort: Effort,
    /// A row per technique and storage.
    pub rows: Vec<Row>,
}

/// What one technique with one storage gave.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Row {
    /// The technique's label.
    pub technique: String,
    /// The storage.
    pub storage: Storage,
    /// Inputs that were drawn and that hill-climbs tried.
    pub samples: u64,
    /// Results that are NaN or infinite.
    pub not_finite: u64,
    /// Finite results outside [0, 1].
    pub outside: u64,
    /// The largest excess over the truth of all inputs but those that are filtered widely; negative where all leak.
    pub excess: Excess,
    /// Excess over inputs that are filtered widely.
    pub wide: Excess,
    /// Quantiles of the excess over the inputs that were drawn, for [`SHARES`].
    pub quantiles: Vec<Quantile>,
    /// The mean over all truths of what is missing to them.
    pub mean_leak: f64,
    /// The input with the largest excess.
    pub worst: Option<Worst>,
    /// The first input whose result is not a shadow intensity, as Rust, and the result.
    pub fault: Option<(String, String)>,
    /// What was drawn from each stratum.
    pub strata: Vec<StratumRow>,
}

/// The largest excess over the truth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Excess {
    /// Largest excess over the inputs that were drawn.
    pub drawn: f64,
    /// Largest excess over the inputs that hill-climbs tried.
    pub climbed: f64,
    /// What is allowed.
    pub allowed: f64,
}

/// The input with the largest excess.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Worst {
    /// The stratum that it was drawn from, or that its climb began in.
    pub stratum: Stratum,
    /// The truth.
    pub truth: f64,
    /// The technique's shadow intensity.
    pub found: f32,
    /// The input.
    pub input: Input,
}

/// A stratum's part of a row.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StratumRow {
    /// The stratum.
    pub stratum: Stratum,
    /// Inputs.
    pub samples: u64,
    /// Results that are NaN or infinite.
    pub not_finite: u64,
    /// Finite results outside [0, 1].
    pub outside: u64,
    /// The largest excess; none where there are no truths.
    pub excess: Option<f64>,
}

impl Row {
    /// The row that follows from the counts of drawn inputs and of hill-climbs.
    #[must_use]
    pub fn new(pair: &MapEncoding, drawn: &Tally, climbed: &Tally) -> Self {
        let worst = [drawn.worst(), climbed.worst()]
            .into_iter()
            .flatten()
            .max_by(|a, b| a.1.excess().total_cmp(&b.1.excess()));
        let excess = |wide: bool| {
            let largest = |tally: &Tally| {
                Stratum::ALL
                    .into_iter()
                    .zip(&tally.strata)
                    .filter(|(stratum, _)| (*stratum == Stratum::FilteredWide) == wide)
                    .filter_map(|(_, tally)| tally.worst.first())
                    .map(Case::excess)
                    .fold(-1.0, f64::max)
            };
            Excess {
                drawn: largest(drawn),
                climbed: largest(climbed),
                allowed: allowed_excess(pair, wide),
            }
        };
        let fault = drawn.first_fault.or(climbed.first_fault);
        Self {
            technique: label(pair.technique()),
            storage: pair.storage(),
            samples: drawn.samples() + climbed.samples(),
            not_finite: drawn.not_finite() + climbed.not_finite(),
            outside: drawn.outside() + climbed.outside(),
            excess: excess(false),
            wide: excess(true),
            quantiles: SHARES.iter().map(|&share| drawn.quantile(share)).collect(),
            mean_leak: drawn.mean_leak(),
            worst: worst.map(|(stratum, case)| Worst {
                stratum,
                truth: case.truth,
                found: case.found,
                input: case.input,
            }),
            fault: fault
                .map(|fault| (format!("{:?}", fault.input), format!("{:e}", fault.found()))),
            strata: Stratum::ALL
                .into_iter()
                .zip(&drawn.strata)
                .map(|(stratum, tally)| StratumRow {
                    stratum,
                    samples: tally.samples,
                    not_finite: tally.not_finite,
                    outside: tally.outside,
                    excess: tally.worst.first().map(Case::excess),
                })
                .collect(),
        }
    }

    /// Whether there is nothing that should not be: NaN, results outside [0, 1], more excess than is allowed.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.not_finite == 0 && self.outside == 0 && self.excess.passed() && self.wide.passed()
    }
}

impl Excess {
    /// Whether no input has more than is allowed.
    #[must_use]
    pub fn passed(self) -> bool {
        self.drawn.max(self.climbed) <= self.allowed
    }
}

impl Report {
    /// Rows with a fault.
    #[must_use]
    pub fn faults(&self) -> usize {
        self.rows.iter().filter(|row| !row.passed()).count()
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: {}", self.adapter, self.effort)?;
        writeln!(
            f,
            "{:<16} {:<8} {:>7} {:>8} {:>9} {:>8} {:>8} {:>8} {:>9} {:>8} {:>8} {:>9}  worst in",
            "technique",
            "storage",
            "NaN/inf",
            "not 0..1",
            "99.9 %",
            "largest",
            "climbed",
            "allowed",
            "wide",
            "climbed",
            "allowed",
            "mean leak"
        )?;
        for row in &self.rows {
            let high = row
                .quantiles
                .iter()
                .find(|quantile| quantile.share == 0.999);
            writeln!(
                f,
                "{:<16} {:<8} {:>7} {:>8} {:>9.1e} {:>8.1e} {:>8.1e} {:>8.1e} {:>9.1e} {:>8.1e} {:>8.1e} {:>9.5}  {}{}",
                row.technique,
                row.storage.name(),
                row.not_finite,
                row.outside,
                high.map_or(0.0, |quantile| quantile.excess),
                row.excess.drawn,
                row.excess.climbed,
                row.excess.allowed,
                row.wide.drawn,
                row.wide.climbed,
                row.wide.allowed,
                row.mean_leak,
                row.worst.as_ref().map_or("", |worst| worst.stratum.name()),
                if row.passed() { "" } else { "  FAULT" }
            )?;
        }
        writeln!(
            f,
            "\nshadow intensity above the truth: of 99.9 % of results, largest, by hill-climbs; allowed; the same for filters \
             over 9 texels wide\n\nworst inputs"
        )?;
        for row in &self.rows {
            let name = format!("{} {}", row.technique, row.storage);
            if let Some(worst) = &row.worst {
                writeln!(
                    f,
                    "{name}: {:?} for {:?}\n    {:?}",
                    worst.found, worst.truth, worst.input
                )?;
            }
            if let Some((input, found)) = &row.fault {
                writeln!(f, "{name}: {found}\n    {input}")?;
            }
        }
        match self.faults() {
            0 => writeln!(f, "\nno faults"),
            faults => writeln!(f, "\n{faults} of {} rows have faults", self.rows.len()),
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::super::kernels::kernels;
    use super::super::truth::truth;
    use super::*;
    use crate::techniques::filterable;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;

    type Evaluate = fn(f64) -> f64;

    /// A row of a technique that gives `evaluate` of the truth.
    fn row(evaluate: Evaluate) -> Row {
        let pair = filterable()
            .into_iter()
            .find(|pair| label(pair.technique()) == "hamburger4")
            .unwrap();
        let kernels = kernels().unwrap();
        let mut random = ChaCha8Rng::seed_from_u64(5);
        let mut tally = Tally::default();
        for stratum in Stratum::ALL {
            for _ in 0..200 {
                let input: Input = stratum.sample(&mut random);
                let truth = truth(&input, &kernels);
                let found = evaluate(truth.unwrap_or(0.5)) as f32;
                tally.add(stratum, &input, truth, found);
            }
        }
        Row::new(&pair, &tally, &Tally::default())
    }

    #[test]
    fn planted_faults_are_reported_and_a_lower_bound_is_none() {
        // Leaks do not count as faults.
        assert!(row(|truth| 0.9 * truth).passed());
        let planted: [(&str, Evaluate); 4] = [
            ("darker than the truth by 1e-3", |truth| {
                (truth + 1e-3).min(1.0)
            }),
            ("NaN in full shadow", |truth| {
                if truth >= 1.0 { f64::NAN } else { 0.0 }
            }),
            (
                "just above 1",
                |truth| if truth >= 1.0 { 1.000_000_2 } else { 0.0 },
            ),
            ("below 0", |truth| 0.5 * truth - 1e-30),
        ];
        for (name, evaluate) in planted {
            let row = row(evaluate);
            assert!(!row.passed(), "{name}");
            let report = Report {
                adapter: "none".to_owned(),
                effort: Effort::QUICK,
                rows: vec![row],
            };
            assert_eq!(report.faults(), 1, "{name}");
            let text = report.to_string();
            assert!(
                text.contains("FAULT") && text.contains("Input { depths: ["),
                "{name}"
            );
        }
    }
}
