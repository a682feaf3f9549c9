//! Running the shader on files of exact moment-problem vectors.

mod agreement;
mod cases;
mod exact;
pub mod file;
mod report;

use std::path::Path;

use moment_shadows::Profile;

use crate::batch::Batch;
use crate::error::LabError;
use crate::gpu::Gpu;
use cases::{Case, Input, Output, Truth, collect};
use exact::{Bound, exact, rationals, unit};

pub use agreement::{AGREEMENT, Agreement, agreement};
pub use report::{ALLOWED_SHARE, ClassReport, HARD_TOLERANCE, TOLERANCE, VectorReport};

/// Evaluates on the best adapter all Hamburger records of two, four and six moments in a file, by `chebyshev_lower_bound` and
/// `chebyshev_upper_bound`, `hamburger4_bounds` and `hamburger6_bounds`, and all Hausdorff records of four, by `hausdorff4_bounds`.
///
/// A biased record is fed bit for bit and compared with the file's bounds. An unbiased one cannot go to the solver, which
/// takes moments after the moment bias: its f32 moments go through `four_moments_apply_bias` or `six_moments_apply_bias` with the bias
/// of each storage on the device, and the result is compared with the oracle's bounds for exactly the biased moments that the
/// device made. Two moments have no bias: their variance is raised to the smallest one of each storage, and so it is for the oracle.
///
/// The oracle itself is compared with all bounds of the file, those that no shader evaluates too.
pub fn run(file: impl AsRef<Path>) -> Result<VectorReport, LabError> {
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

/// Compares what the shader gave for a case with the truth.
fn judge(case: &Case<'_>, output: &Output, report: &mut VectorReport) {
    let found = [output.lower, output.upper];
    let [lower, upper] = found;
    let sound = 0.0 <= lower && lower <= upper && upper <= 1.0;
    let m = case.vector.m;
    let (bounds, units, classes) = match case.truth {
        Truth::Given { bounds, units } => (bounds, units, &mut report.biased),
        Truth::Oracle(storage) => {
            let moments = output.moments(m);
            let depth = f64::from(case.input.depth);
            let exact = rationals(&moments)
                .and_then(|moments| exact(case.bound, moments, depth, output.smallest_variance(m)));
            match exact {
                Ok((bounds, Some(sensitivities))) => {
                    let alpha = f64::from(case.input.alpha);
                    let units = sensitivities.map(|sensitivity| unit(m, alpha, sensitivity));
                    (bounds, units, &mut report.unbiased)
                }
                _ if sound => {
                    let reason = format!(
                        "{} bounds of {m} moments: the bias of {} leaves the f32 moments singular or impossible",
                        case.bound.name(),
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
    let class = match (case.bound, m) {
        (Bound::Hamburger, 4) => case.vector.class.clone(),
        (Bound::Hamburger, _) => format!("{}, {m} moments", case.vector.class),
        (Bound::Hausdorff, _) => format!("{}, Hausdorff", case.vector.class),
    };
    classes.entry(class).or_default().add(error, sound);
}
