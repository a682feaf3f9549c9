//! Running the shader on files of exact moment-problem vectors.

mod agreement;
pub mod file;
mod report;

use std::path::Path;

use bytemuck::{Pod, Zeroable};
use moment_shadows::{Profile, Storage};

use crate::batch::{Batch, BatchError};
use crate::gpu::{Gpu, GpuError};
use crate::oracle::{OracleError, hamburger, rational, sensitivity, tolerance_unit};

pub use agreement::{AGREEMENT, Agreement, agreement};
pub use file::VectorFileError;
pub use report::{ALLOWED_SHARE, ClassReport, HARD_TOLERANCE, TOLERANCE, VectorReport};

/// Why vectors could not be evaluated.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum VectorsError {
    /// The file is wrong.
    #[error(transparent)]
    File(#[from] VectorFileError),
    /// There is no device.
    #[error(transparent)]
    Gpu(#[from] GpuError),
    /// The shader did not run.
    #[error(transparent)]
    Batch(#[from] BatchError),
}

/// `BatchInput` of the shader.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Input {
    odd: [f32; 3],
    depth: f32,
    even: [f32; 3],
    alpha: f32,
    target: [f32; 3],
    count: u32,
    is_biased: u32,
    padding: [u32; 3],
}

impl Input {
    /// Of four or six moments.
    fn new(moments: &[f32], depth: f64, alpha: f32) -> Self {
        let of = |index: usize| moments.get(index).copied().unwrap_or_default();
        Self {
            odd: [0, 2, 4].map(of),
            depth: depth as f32,
            even: [1, 3, 5].map(of),
            alpha,
            target: [0.0; 3],
            count: moments.len() as u32,
            is_biased: 1,
            padding: [0; 3],
        }
    }

    /// Moments that are yet to be biased towards these even ones.
    fn towards(self, target: [f32; 3]) -> Self {
        Self {
            target,
            is_biased: 0,
            ..self
        }
    }
}

/// `BatchOutput` of the shader.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Output {
    odd: [f32; 3],
    lower: f32,
    even: [f32; 3],
    upper: f32,
}

/// What the shader's bounds for an input are compared with.
enum Truth {
    /// The file's own bounds and the units of their errors.
    Given { bounds: [f64; 2], units: [f64; 2] },
    /// The exact bounds for the moments that the shader made by applying the bias of a storage.
    Oracle(Storage),
}

struct Case<'a> {
    vector: &'a file::Vector,
    input: Input,
    truth: Truth,
}

/// Evaluates all Hamburger records of four and six moments in a file with `hamburger4_bounds` and `hamburger6_bounds` on the best
/// adapter.
///
/// A biased record is fed bit for bit and compared with the file's bounds. An unbiased one is no input for the solver, which
/// takes moments after the moment bias: its f32 moments go through `four_moments_apply_bias` or `six_moments_apply_bias` with the bias of each storage on the
/// device, and the result is compared with the oracle's bounds for exactly the biased moments that the device made.
///
/// The oracle itself is compared with all bounds of the file, those that no shader evaluates too.
pub fn run(file: impl AsRef<Path>) -> Result<VectorReport, VectorsError> {
    let vectors = file::read(file.as_ref())?;
    let gpu = Gpu::open(Profile::WebgpuCore)?;
    let mut report = VectorReport {
        adapter: gpu.adapter.get_info().name,
        oracle: agreement(&vectors),
        ..VectorReport::default()
    };
    let mut cases = Vec::new();
    for vector in &vectors {
        collect(vector, &mut cases, &mut report);
    }
    if cases.is_empty() {
        return Ok(report);
    }
    let shader = Batch::<Input, Output>::new(
        &gpu,
        "vectors/evaluate.wgsl",
        include_str!("vectors/evaluate.wgsl"),
    )?;
    let inputs: Vec<Input> = cases.iter().map(|case| case.input).collect();
    let outputs = shader.run(&inputs)?;
    for (case, output) in cases.iter().zip(&outputs) {
        judge(case, output, &mut report);
    }
    Ok(report)
}

/// Sorts a vector's records into those to evaluate and those not.
fn collect<'a>(vector: &'a file::Vector, cases: &mut Vec<Case<'a>>, report: &mut VectorReport) {
    let mut skip = |reason: String, count: usize| {
        if count > 0 {
            *report.not_evaluated.entry(reason).or_default() += count;
        }
    };
    let records = 1 + vector.biased.len();
    let m = vector.m;
    if m != 4 && m != 6 {
        let reason = format!("bounds of {m} moments: the technique is not implemented");
        skip(reason, 2 * records);
        return;
    }
    skip(
        format!("Hausdorff bounds of {m} moments: the technique is not implemented"),
        records,
    );
    let rounded: Vec<f32> = vector.moments_f32.iter().map(|&b| b as f32).collect();
    for storage in Storage::OF_FOUR_MOMENTS {
        let four = storage.moment_bias();
        let (alpha, target) = match storage.six_moments_bias().filter(|_| m == 6) {
            Some(bias) => (bias.alpha, bias.even),
            None => (four.alpha, [four.second, four.fourth, 0.0]),
        };
        cases.push(Case {
            vector,
            input: Input::new(&rounded, vector.depth, alpha).towards(target),
            truth: Truth::Oracle(storage),
        });
    }
    for record in &vector.biased {
        let bounds = record.hamburger.and_then(file::Bounds::both);
        let (Ok(moments), Some(bounds)) = (record.input(), bounds) else {
            let reason = "the file gives none, since the rounded input is no moment vector";
            skip(format!("Hamburger bounds of {m} moments: {reason}"), 1);
            continue;
        };
        let Some(units) = units(record, &moments) else {
            let reason = "no tolerance is given or defined";
            skip(format!("Hamburger bounds of {m} moments: {reason}"), 1);
            continue;
        };
        cases.push(Case {
            vector,
            input: Input::new(&moments, record.depth, record.alpha as f32),
            truth: Truth::Given { bounds, units },
        });
    }
}

/// The units of a biased record's errors: from its tolerance, else its sensitivity, else the oracle's sensitivity.
fn units(record: &file::Biased, moments: &[f32]) -> Option<[f64; 2]> {
    let pair = |values: Option<[Option<f64>; 2]>| values.and_then(|[a, b]| Some([a?, b?]));
    if let Some(tolerances) = pair(record.tol) {
        return Some(tolerances.map(|tolerance| tolerance / TOLERANCE));
    }
    let sensitivities = pair(record.sens).or_else(|| exact(moments, record.depth).ok()?.1)?;
    let unit = |sensitivity| unit(moments.len(), record.alpha, sensitivity);
    Some(sensitivities.map(unit))
}

/// The unit of errors: 2^-24 (1 + sensitivity) for four moments. For six it is four times as much, and 16 times where the bias
/// leaves pivots that are so small that their roundings count.
fn unit(count: usize, alpha: f64, sensitivity: f64) -> f64 {
    let factor = match count {
        4 => 1.0,
        _ if alpha >= 5e-5 => 4.0,
        _ => 16.0,
    };
    factor * tolerance_unit(sensitivity)
}

/// Exact bounds and their sensitivities.
fn exact(moments: &[f32], depth: f64) -> Result<([f64; 2], Option<[f64; 2]>), OracleError> {
    let moments = moments
        .iter()
        .map(|&moment| rational(f64::from(moment)))
        .collect::<Result<Vec<_>, _>>()?;
    let depth = rational(depth)?;
    let extremal = hamburger(&moments, &depth)?;
    let sensitivities = sensitivity(&moments, &depth, &extremal);
    Ok(([extremal.lower, extremal.upper], sensitivities))
}

/// Compares what the shader gave for a case with the truth.
fn judge(case: &Case<'_>, output: &Output, report: &mut VectorReport) {
    let found = [output.lower, output.upper];
    let [lower, upper] = found;
    let m = case.vector.m;
    let sound = 0.0 <= lower && lower <= upper && upper <= 1.0;
    let (bounds, units, classes) = match case.truth {
        Truth::Given { bounds, units } => (bounds, units, &mut report.biased),
        Truth::Oracle(storage) => {
            let ([b1, b3, b5], [b2, b4, b6]) = (output.odd, output.even);
            let biased = [b1, b2, b3, b4, b5, b6];
            match exact(&biased[..m.min(6)], f64::from(case.input.depth)) {
                Ok((bounds, Some(sensitivities))) => (
                    bounds,
                    sensitivities
                        .map(|sensitivity| unit(m, f64::from(case.input.alpha), sensitivity)),
                    &mut report.unbiased,
                ),
                _ if sound => {
                    let reason = format!(
                        "Hamburger bounds of {m} moments: the bias of {} leaves the f32 moments singular or impossible",
                        storage.name()
                    );
                    *report.not_evaluated.entry(reason).or_default() += 1;
                    return;
                }
                // Whatever the moments, the bounds must be in range and in order.
                _ => ([f64::NAN; 2], [1.0; 2], &mut report.unbiased),
            }
        }
    };
    let error = (0..2)
        .map(|side| (f64::from(found[side]) - bounds[side]).abs() / units[side])
        // `f64::max` would drop NaN.
        .fold(0.0, |largest, error| {
            if error > largest || error.is_nan() {
                error
            } else {
                largest
            }
        });
    let class = match m {
        4 => case.vector.class.clone(),
        _ => format!("{}, {m} moments", case.vector.class),
    };
    classes.entry(class).or_default().add(error, sound);
}
