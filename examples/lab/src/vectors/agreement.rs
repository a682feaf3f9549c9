//! Whether the lab's oracle gives the bounds that a file of vectors states: for all numbers of moments, on the real line and
//! on the interval.

use std::collections::BTreeMap;
use std::str::FromStr;

use dashu::rational::RBig;

use super::exact::{Bound, rationals};
use super::file::{Bounds, Vector};
use crate::oracle::{Extremal, OracleError};

/// The largest difference that counts as agreement. Files state 17 digits.
pub const AGREEMENT: f64 = 1e-15;

/// How a set of bounds of the oracle compares with a file's.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Agreement {
    /// Pairs of bounds.
    pub evaluated: usize,
    /// The largest difference of a lower or upper bound; infinite where the oracle has none.
    pub largest: f64,
}

impl Agreement {
    fn add(&mut self, ours: Result<Extremal, OracleError>, theirs: [f64; 2]) {
        self.evaluated += 1;
        let difference = ours.map_or(f64::INFINITY, |ours| {
            let [lower, upper] = theirs;
            (ours.lower - lower).abs().max((ours.upper - upper).abs())
        });
        self.largest = self.largest.max(difference);
    }

    /// Whether no difference is larger than [`AGREEMENT`].
    #[must_use]
    pub fn passed(&self) -> bool {
        self.largest <= AGREEMENT
    }
}

/// Compares all bounds of vectors, by kind and number of moments. No device is needed.
#[must_use]
pub fn agreement(vectors: &[Vector]) -> BTreeMap<String, Agreement> {
    let mut by_kind = BTreeMap::new();
    for vector in vectors {
        compare(vector, &mut by_kind);
    }
    by_kind
}

/// Compares all bounds of a vector, those of its exact moments and of its biased ones.
fn compare(vector: &Vector, by_kind: &mut BTreeMap<String, Agreement>) {
    let mut compare = |moments: &[RBig], depth: f64, kinds: [Option<Bounds>; 2]| {
        for (bound, theirs) in Bound::BOTH.into_iter().zip(kinds) {
            if let Some(theirs) = theirs.and_then(Bounds::both) {
                let ours = bound.extremal(moments, vector.interval, depth);
                let name = format!("{}, {} moments", bound.name(), vector.m);
                by_kind.entry(name).or_default().add(ours, theirs);
            }
        }
    };
    // The file was checked when it was read.
    let moments = vector.moments.iter().map(|text| RBig::from_str(text));
    if let Ok(moments) = moments.collect::<Result<Vec<RBig>, _>>() {
        compare(&moments, vector.depth, [vector.hamburger, vector.hausdorff]);
    }
    for record in &vector.biased {
        if let Ok(moments) = rationals(&record.input().unwrap_or_default()) {
            compare(&moments, record.depth, [record.hamburger, record.hausdorff]);
        }
    }
}
