//! The report as a table.

use core::fmt;

use moment_shadows::{MapEncoding, Storage};
use serde::Serialize;

use super::Effort;
use super::judge::{Case, Quantile, Tally};
use super::limits::largest_excess;
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
    /// The largest excess over the truth of the inputs that were drawn; negative where all leak.
    pub drawn: f64,
    /// The largest that a hill-climb reached.
    pub climbed: f64,
    /// The excess that is documented for the pair.
    pub documented: f64,
    /// Of the inputs that were drawn, for [`SHARES`].
    pub quantiles: Vec<Quantile>,
    /// The mean over all truths of what is missing to them.
    pub mean_leak: f64,
    /// The worst input: its excess is the larger of both.
    pub worst: Option<Worst>,
    /// The first input whose result is no shadow intensity, as Rust, and the result.
    pub fault: Option<(String, String)>,
    /// What was drawn from each stratum.
    pub strata: Vec<StratumRow>,
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
    /// The input, as Rust.
    pub input: String,
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
    pub largest: Option<f64>,
}

impl Row {
    /// Of the counts of drawn inputs and of hill-climbs.
    #[must_use]
    pub fn new(pair: &MapEncoding, drawn: &Tally, climbed: &Tally) -> Self {
        let (a, b) = (drawn.worst(), climbed.worst());
        let largest = |worst: Option<(Stratum, Case)>| worst.map_or(0.0, |worst| worst.1.excess());
        let [of_drawn, of_climbed] = [largest(a), largest(b)];
        let worst = if of_climbed > of_drawn { b } else { a };
        let fault = drawn.first_fault.or(climbed.first_fault);
        Self {
            technique: label(pair.technique()),
            storage: pair.storage(),
            samples: drawn.samples() + climbed.samples(),
            not_finite: drawn.not_finite() + climbed.not_finite(),
            outside: drawn.outside() + climbed.outside(),
            drawn: of_drawn,
            climbed: of_climbed,
            documented: largest_excess(pair),
            quantiles: SHARES.iter().map(|&share| drawn.quantile(share)).collect(),
            mean_leak: drawn.mean_leak(),
            worst: worst.map(|(stratum, case)| Worst {
                stratum,
                truth: case.truth,
                found: case.found,
                input: case.input.literal(),
            }),
            fault: fault.map(|(input, found)| (input.literal(), format!("{found:e}"))),
            strata: Stratum::ALL
                .into_iter()
                .zip(&drawn.strata)
                .map(|(stratum, tally)| StratumRow {
                    stratum,
                    samples: tally.samples,
                    not_finite: tally.not_finite,
                    outside: tally.outside,
                    largest: tally.worst.first().map(Case::excess),
                })
                .collect(),
        }
    }

    /// The largest excess of all inputs.
    #[must_use]
    pub fn largest(&self) -> f64 {
        self.drawn.max(self.climbed)
    }

    /// Whether there is nothing that should not be: NaN, results outside [0, 1], more excess than is documented.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.not_finite == 0 && self.outside == 0 && self.largest() <= self.documented
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
        writeln!(
            f,
            "{}: {} inputs per technique and storage, {} hill-climbs of {} steps, seed {}",
            self.adapter,
            self.effort.samples,
            super::CLIMBS,
            self.effort.steps,
            self.effort.seed
        )?;
        writeln!(
            f,
            "{:<16} {:<8} {:>8} {:>8}  {:>9} {:>9} {:>9} {:>9}  {:>9}  {:>9}",
            "technique",
            "storage",
            "NaN/inf",
            "not 0..1",
            "excess",
            "climbed",
            "allowed",
            "99.9 %",
            "mean leak",
            "worst in"
        )?;
        for row in &self.rows {
            let high = row
                .quantiles
                .iter()
                .find(|quantile| quantile.share == 0.999);
            writeln!(
                f,
                "{:<16} {:<8} {:>8} {:>8}  {:>9.2e} {:>9.2e} {:>9.2e} {:>9.2e}  {:>9.5}  {}{}",
                row.technique,
                row.storage.name(),
                row.not_finite,
                row.outside,
                row.drawn,
                row.climbed,
                row.documented,
                high.map_or(0.0, |quantile| quantile.excess),
                row.mean_leak,
                row.worst.as_ref().map_or("", |worst| worst.stratum.name()),
                if row.passed() { "" } else { "  FAULT" }
            )?;
        }
        writeln!(f, "\nworst inputs")?;
        for row in &self.rows {
            let name = format!("{} {}", row.technique, row.storage);
            if let Some(worst) = &row.worst {
                writeln!(
                    f,
                    "{name}: {:?} for {:?}\n    {}",
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
