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
    moments: [f32; 4],
    depth: f32,
    alpha: f32,
    beta: f32,
    padding: f32,
}

/// `BatchOutput` of the shader.
#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Output {
    biased: [f32; 4],
    bounds: [f32; 2],
    padding: [f32; 2],
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

/// Evaluates all four-moment Hamburger records of a file with `hamburger_bounds` on the best adapter.
///
/// A biased record is fed bit for bit and compared with the file's bounds. An unbiased one is no input for the solver, which
/// takes moments after the moment bias: its f32 moments go through `moments_apply_bias` with the bias of each storage on the
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
    let &[b1, b2, b3, b4] = vector.moments_f32.as_slice() else {
        let reason = format!(
            "bounds of {} moments: the technique is not implemented",
            vector.m
        );
        skip(reason, 2 * records);
        return;
    };
    skip(
        "Hausdorff bounds of 4 moments: the technique is not implemented".to_owned(),
        records,
    );
    for storage in Storage::ALL {
        let bias = storage.moment_bias();
        cases.push(Case {
            vector,
            input: Input {
                moments: [b1 as f32, b2 as f32, b3 as f32, b4 as f32],
                depth: vector.depth as f32,
                alpha: bias.alpha,
                beta: bias.second,
                padding: 0.0,
            },
            truth: Truth::Oracle(storage),
        });
    }
    for record in &vector.biased {
        let input: Option<[f32; 4]> = record.input().ok().and_then(|input| input.try_into().ok());
        let bounds = record.hamburger.and_then(file::Bounds::both);
        let (Some(moments), Some(bounds)) = (input, bounds) else {
            skip(
                "Hamburger bounds of 4 moments: the file gives none, since the rounded input is no moment vector"
                    .to_owned(),
                1,
            );
            continue;
        };
        let Some(units) = units(record, moments) else {
            skip(
                "Hamburger bounds of 4 moments: no tolerance is given or defined".to_owned(),
                1,
            );
            continue;
        };
        cases.push(Case {
            vector,
            input: Input {
                moments,
                depth: record.depth as f32,
                alpha: record.alpha as f32,
                beta: -1.0,
                padding: 0.0,
            },
            truth: Truth::Given { bounds, units },
        });
    }
}

/// The units of a biased record's errors: from its tolerance, else its sensitivity, else the oracle's sensitivity.
fn units(record: &file::Biased, moments: [f32; 4]) -> Option<[f64; 2]> {
    let pair = |values: Option<[Option<f64>; 2]>| values.and_then(|[a, b]| Some([a?, b?]));
    if let Some(tolerances) = pair(record.tol) {
        return Some(tolerances.map(|tolerance| tolerance / TOLERANCE));
    }
    let sensitivities = pair(record.sens).or_else(|| exact(moments, record.depth).ok()?.1)?;
    Some(sensitivities.map(tolerance_unit))
}

/// Exact bounds and their sensitivities.
fn exact(moments: [f32; 4], depth: f64) -> Result<([f64; 2], Option<[f64; 2]>), OracleError> {
    let moments = moments
        .into_iter()
        .map(|moment| rational(f64::from(moment)))
        .collect::<Result<Vec<_>, _>>()?;
    let depth = rational(depth)?;
    let extremal = hamburger(&moments, &depth)?;
    let sensitivities = sensitivity(&moments, &depth, &extremal);
    Ok(([extremal.lower, extremal.upper], sensitivities))
}

/// Compares what the shader gave for a case with the truth.
fn judge(case: &Case<'_>, output: &Output, report: &mut VectorReport) {
    let [lower, upper] = output.bounds;
    let sound = 0.0 <= lower && lower <= upper && upper <= 1.0;
    let (bounds, units, classes) = match case.truth {
        Truth::Given { bounds, units } => (bounds, units, &mut report.biased),
        Truth::Oracle(storage) => {
            match exact(output.biased, f64::from(case.input.depth)) {
                Ok((bounds, Some(sensitivities))) => (
                    bounds,
                    sensitivities.map(tolerance_unit),
                    &mut report.unbiased,
                ),
                _ if sound => {
                    let reason = format!(
                        "Hamburger bounds of 4 moments: the bias of {} leaves the f32 moments singular or impossible",
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
        .map(|side| (f64::from(output.bounds[side]) - bounds[side]).abs() / units[side])
        // `f64::max` would drop NaN.
        .fold(0.0, |largest, error| {
            if error > largest || error.is_nan() {
                error
            } else {
                largest
            }
        });
    classes
        .entry(case.vector.class.clone())
        .or_default()
        .add(error, sound);
}
