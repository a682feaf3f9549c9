//! What of a file of vectors the shader evaluates, as it takes it.

use bytemuck::{Pod, Zeroable};
use moment_shadows::Storage;

use super::exact::{Bound, exact, rationals, unit};
use super::file;
use super::report::{TOLERANCE, VectorReport};

/// `BatchInput` of the shader.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct Input {
    odd: [f32; 3],
    pub(super) depth: f32,
    even: [f32; 3],
    pub(super) alpha: f32,
    target: [f32; 3],
    count: u32,
    is_biased: u32,
    is_hausdorff: u32,
    storage: u32,
    padding: u32,
}

impl Input {
    /// A case of two, four or six moments that are biased already.
    fn new(bound: Bound, moments: &[f32], depth: f64, alpha: f32) -> Self {
        let of = |index: usize| moments.get(index).copied().unwrap_or_default();
        Self {
            odd: [0, 2, 4].map(of),
            depth: depth as f32,
            even: [1, 3, 5].map(of),
            alpha,
            target: [0.0; 3],
            count: moments.len() as u32,
            is_biased: 1,
            is_hausdorff: u32::from(bound == Bound::Hausdorff),
            storage: 0,
            padding: 0,
        }
    }

    /// Moments that are yet to be biased for a storage.
    fn unbiased(bound: Bound, moments: &[f32], depth: f64, storage: Storage) -> Self {
        let four = match bound {
            Bound::Hamburger => storage.moment_bias(),
            Bound::Hausdorff => storage.hausdorff_moment_bias(),
        };
        let (alpha, target) = match storage.six_moments_bias().filter(|_| moments.len() == 6) {
            Some(bias) => (bias.alpha, bias.even),
            None => (four.alpha, [four.second, four.fourth, 0.0]),
        };
        Self {
            target,
            is_biased: 0,
            storage: storage.wgsl_index(),
            ..Self::new(bound, moments, depth, alpha)
        }
    }
}

/// `BatchOutput` of the shader.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
pub(super) struct Output {
    odd: [f32; 3],
    pub(super) lower: f32,
    even: [f32; 3],
    pub(super) upper: f32,
    smallest_variance: f32,
    padding: [f32; 3],
}

impl Output {
    /// The first `count` moments, as the solver got them.
    pub(super) fn moments(&self, count: usize) -> Vec<f32> {
        let pairs = self.odd.iter().zip(&self.even);
        let all = pairs.flat_map(|(&odd, &even)| [odd, even]);
        all.take(count).collect()
    }

    /// What a variance was raised to, where there are two moments; others are not raised.
    pub(super) fn smallest_variance(&self, count: usize) -> f32 {
        if count == 2 {
            self.smallest_variance
        } else {
            0.0
        }
    }
}

/// What the shader's bounds for an input are compared with.
pub(super) enum Truth {
    /// The file's own bounds and the units of their errors.
    Given { bounds: [f64; 2], units: [f64; 2] },
    /// The exact bounds for the moments that the shader made by applying the bias of a storage.
    Oracle(Storage),
}

pub(super) struct Case<'a> {
    pub(super) vector: &'a file::Vector,
    pub(super) bound: Bound,
    pub(super) input: Input,
    pub(super) truth: Truth,
}

/// Sorts a vector's records into those to evaluate and those not.
pub(super) fn collect<'a>(
    vector: &'a file::Vector,
    cases: &mut Vec<Case<'a>>,
    report: &mut VectorReport,
) {
    for bound in Bound::BOTH {
        let mut skip = |reason: &str, count: usize| {
            let reason = format!("{} bounds of {} moments: {reason}", bound.name(), vector.m);
            if count > 0 {
                *report.not_evaluated.entry(reason).or_default() += count;
            }
        };
        let is_there = match bound {
            Bound::Hamburger => matches!(vector.m, 2 | 4 | 6),
            Bound::Hausdorff => vector.m == 4,
        };
        if !is_there {
            skip("the technique is not implemented", 1 + vector.biased.len());
            continue;
        }
        if bound == Bound::Hausdorff && vector.interval != [-1.0, 1.0] {
            skip(
                "depth is in another interval than [-1, 1]",
                1 + vector.biased.len(),
            );
            continue;
        }
        let rounded: Vec<f32> = vector.moments_f32.iter().map(|&b| b as f32).collect();
        match out_of_reach(bound, vector.depth) {
            Some(reason) => skip(reason, 1),
            None => cases.extend(Storage::OF_FOUR_MOMENTS.map(|storage| Case {
                vector,
                bound,
                input: Input::unbiased(bound, &rounded, vector.depth, storage),
                truth: Truth::Oracle(storage),
            })),
        }
        for record in &vector.biased {
            match biased(bound, vector, record) {
                Ok(case) => cases.push(case),
                Err(reason) => skip(reason, 1),
            }
        }
    }
}

/// Why the shader's answer for a fragment is another than the file's.
fn out_of_reach(bound: Bound, depth: f64) -> Option<&'static str> {
    match bound {
        Bound::Hamburger => None,
        Bound::Hausdorff => (depth.abs() > 1.0)
            .then_some("a fragment outside of the interval counts as one at its end"),
    }
}

/// A biased record, or why it cannot be compared.
fn biased<'a>(
    bound: Bound,
    vector: &'a file::Vector,
    record: &file::Biased,
) -> Result<Case<'a>, &'static str> {
    let given = match bound {
        Bound::Hamburger => record.hamburger,
        Bound::Hausdorff => record.hausdorff,
    };
    let (Ok(moments), Some(bounds)) = (record.input(), given.and_then(file::Bounds::both)) else {
        return Err("the file gives none, since the rounded input is no moment vector");
    };
    if let Some(reason) = out_of_reach(bound, record.depth) {
        return Err(reason);
    }
    if bound == Bound::Hausdorff && !has_digits(&moments, record.alpha) {
        return Err("the bias of the file and rounding leave no digit of the second pivot");
    }
    let units = units(bound, record, &moments).ok_or("no tolerance is given or defined")?;
    Ok(Case {
        vector,
        bound,
        input: Input::new(bound, &moments, record.depth, record.alpha as f32),
        truth: Truth::Given { bounds, units },
    })
}

/// Whether an f32 solver of Hausdorff bounds has any digit of its second pivot, that of the moments of (1 - z^2) dS. A file may bias
/// towards moments on the boundary of those on [-1, 1], where that pivot is 0; the library's own bias leaves it 0.11 alpha.
fn has_digits(moments: &[f32], alpha: f64) -> bool {
    let b = |index: usize| moments.get(index).copied().map_or(0.0, f64::from);
    let [m0, m1, m2] = [1.0 - b(1), b(0) - b(2), b(1) - b(3)];
    m2 - m1 * m1 / m0 >= 0.02 * alpha
}

/// The units of a biased record's errors: from its tolerance, else its sensitivity, else the oracle's sensitivity. The file's own
/// are those of Hamburger bounds.
fn units(bound: Bound, record: &file::Biased, moments: &[f32]) -> Option<[f64; 2]> {
    let pair = |values: Option<[Option<f64>; 2]>| {
        let [lower, upper] = values.filter(|_| bound == Bound::Hamburger)?;
        Some([lower?, upper?])
    };
    if let Some(tolerances) = pair(record.tol) {
        return Some(tolerances.map(|tolerance| tolerance / TOLERANCE));
    }
    let of_oracle = || {
        exact(bound, rationals(moments).ok()?, record.depth, 0.0)
            .ok()?
            .1
    };
    let sensitivities = pair(record.sens).or_else(of_oracle)?;
    Some(sensitivities.map(|sensitivity| unit(moments.len(), record.alpha, sensitivity)))
}
