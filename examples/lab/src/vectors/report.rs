//! What came out of evaluating vectors, by class.

use std::collections::BTreeMap;
use std::fmt;

use super::agreement::Agreement;

/// The largest error that counts as within tolerance, in units of 2^-24 (1 + sensitivity).
pub const TOLERANCE: f64 = 8.0;

/// The error that not even one record may reach, in the same units.
pub const HARD_TOLERANCE: f64 = 32.0;

/// The share of records that may lie between the two tolerances.
pub const ALLOWED_SHARE: f64 = 1e-5;

/// Errors of the records of one class.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ClassReport {
    /// Records whose bounds were compared.
    pub evaluated: usize,
    /// The largest error of a lower or upper bound, in units of 2^-24 (1 + sensitivity) or a multiple of that; infinite for NaN.
    pub largest: f64,
    /// Records beyond [`TOLERANCE`].
    pub beyond: usize,
    /// Records beyond [`HARD_TOLERANCE`], or outside `0 <= lower <= upper <= 1`.
    pub far_beyond: usize,
}

impl ClassReport {
    /// Takes in a record's error; `sound` is whether its bounds are in range and in order.
    pub(super) fn add(&mut self, error: f64, sound: bool) {
        self.evaluated += 1;
        let error = if error.is_nan() { f64::INFINITY } else { error };
        self.largest = self.largest.max(error);
        self.beyond += usize::from(error > TOLERANCE);
        self.far_beyond += usize::from(error > HARD_TOLERANCE || !sound);
    }

    fn merge(&mut self, other: &Self) {
        self.evaluated += other.evaluated;
        self.largest = self.largest.max(other.largest);
        self.beyond += other.beyond;
        self.far_beyond += other.far_beyond;
    }
}

/// The result of evaluating a file of vectors on the shader.
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct VectorReport {
    /// The adapter that ran the shader.
    pub adapter: String,
    /// Records with a moment bias of their own, by class.
    pub biased: BTreeMap<String, ClassReport>,
    /// Records without a moment bias, by class, evaluated once for the bias of each of our storages.
    pub unbiased: BTreeMap<String, ClassReport>,
    /// How the lab's oracle compares with the file, by kind of bounds.
    pub oracle: BTreeMap<String, Agreement>,
    /// How many pairs of bounds the shader did not evaluate, by reason.
    pub not_evaluated: BTreeMap<String, usize>,
}

impl VectorReport {
    /// All classes together.
    #[must_use]
    pub fn total(&self) -> ClassReport {
        let mut total = ClassReport::default();
        for class in self.biased.values().chain(self.unbiased.values()) {
            total.merge(class);
        }
        total
    }

    /// Whether something was evaluated, all of it within [`HARD_TOLERANCE`] and in range, and no more than
    /// [`ALLOWED_SHARE`] of it beyond [`TOLERANCE`], and the oracle agrees with the file.
    #[must_use]
    pub fn passed(&self) -> bool {
        let total = self.total();
        total.evaluated > 0
            && total.far_beyond == 0
            && total.beyond as f64 <= ALLOWED_SHARE * total.evaluated as f64
            && self.oracle.values().all(Agreement::passed)
    }
}

impl fmt::Display for VectorReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let row = |f: &mut fmt::Formatter<'_>, name: &str, class: &ClassReport| {
            writeln!(
                f,
                "{name:<34} {:>9} {:>9.2} {:>8} {:>8}",
                class.evaluated, class.largest, class.beyond, class.far_beyond
            )
        };
        writeln!(
            f,
            "Hamburger bounds of two, four and six moments and Hausdorff bounds of four on {}",
            self.adapter
        )?;
        writeln!(
            f,
            "error in units of 2^-24 (1 + sensitivity), the larger of lower and upper bound; of six moments in units four times that,\nor 16 times for a bias below 5e-5"
        )?;
        for (title, classes) in [
            ("biased records", &self.biased),
            ("unbiased, our three biases", &self.unbiased),
        ] {
            writeln!(
                f,
                "\n{title:<34} {:>9} {:>9} {:>8} {:>8}",
                "evaluated", "largest", "beyond 8", "over 32"
            )?;
            for (name, class) in classes {
                row(f, name, class)?;
            }
        }
        writeln!(f)?;
        row(f, "all", &self.total())?;
        let title = "the oracle's difference";
        writeln!(f, "\n{title:<34} {:>9} {:>9}", "evaluated", "largest")?;
        for (name, agreement) in &self.oracle {
            writeln!(
                f,
                "{name:<34} {:>9} {:>9.1e}",
                agreement.evaluated, agreement.largest
            )?;
        }
        if !self.not_evaluated.is_empty() {
            writeln!(f, "\nnot evaluated by the shader")?;
            for (reason, count) in &self.not_evaluated {
                writeln!(f, "{count:>6}  {reason}")?;
            }
        }
        let verdict = if self.passed() { "passed" } else { "FAILED" };
        write!(f, "\n{verdict}")
    }
}
