//! What functions gave, beside what vectors say.

use core::fmt;

use moment_shadows::{Target, VectorRow, Vectors};

/// How many rows agree, each counted once.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// Rows.
    pub rows: usize,
    /// Rows with the bits of the vectors, rounded step by step.
    pub equal: usize,
    /// Other rows with the bits where `fma` is rounded once.
    pub fused: usize,
    /// Other rows within the tolerance.
    pub within: usize,
    /// Rows beyond the tolerance.
    pub beyond: usize,
    /// Rows with other bits than WGSL's on the same adapter.
    pub other_than_wgsl: usize,
}

/// A file of functions in a language, function by function.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Compared {
    /// The technique and the storage.
    pub name: String,
    /// The language.
    pub target: Target,
    /// Each function with its rows.
    pub functions: Vec<(String, Counts)>,
}

impl Compared {
    /// Compares what was given for the rows of vectors.
    #[must_use]
    pub fn new(
        name: String,
        target: Target,
        vectors: &Vectors,
        given: &[Vec<u32>],
        wgsl: &[Vec<u32>],
    ) -> Self {
        let mut rows = given.iter().zip(wgsl);
        let functions = vectors.functions.iter().map(|function| {
            let mut counts = Counts::default();
            for row in &function.rows {
                let Some((given, wgsl)) = rows.next() else {
                    continue;
                };
                counts.rows += 1;
                *class(&mut counts, row, given) += 1;
                counts.other_than_wgsl += usize::from(given != wgsl);
            }
            (function.name.clone(), counts)
        });
        Self {
            name,
            target,
            functions: functions.collect(),
        }
    }

    /// All functions together.
    #[must_use]
    pub fn total(&self) -> Counts {
        let mut total = Counts::default();
        for (_, counts) in &self.functions {
            total.rows += counts.rows;
            total.equal += counts.equal;
            total.fused += counts.fused;
            total.within += counts.within;
            total.beyond += counts.beyond;
            total.other_than_wgsl += counts.other_than_wgsl;
        }
        total
    }
}

fn class<'a>(counts: &'a mut Counts, row: &VectorRow, given: &[u32]) -> &'a mut usize {
    let is = |bits: &[moment_shadows::Bits]| bits.iter().map(|it| it.0).eq(given.iter().copied());
    let pairs = row.bits.iter().zip(given).zip(&row.tolerance);
    let is_within = given.len() == row.bits.len()
        && pairs.into_iter().all(|((bits, given), tolerance)| {
            let distance = (f32::from_bits(bits.0) - f32::from_bits(*given)).abs();
            bits.0 == *given || distance <= *tolerance
        });
    if is(&row.bits) {
        &mut counts.equal
    } else if row.fused.as_ref().is_some_and(|fused| is(fused)) {
        &mut counts.fused
    } else if is_within {
        &mut counts.within
    } else {
        &mut counts.beyond
    }
}

impl fmt::Display for Compared {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let total = self.total();
        write!(
            f,
            "{:<28} {:<5} {:>9} {:>6} {:>6} {:>6} {:>7} {:>7} {:>11}",
            self.name,
            self.target.name(),
            self.functions.len(),
            total.rows,
            total.equal,
            total.fused,
            total.within,
            total.beyond,
            total.other_than_wgsl
        )?;
        for (name, counts) in self.functions.iter().filter(|(_, it)| it.beyond > 0) {
            write!(
                f,
                "\n    {name}: {} of {} rows beyond the tolerance",
                counts.beyond, counts.rows
            )?;
        }
        Ok(())
    }
}
