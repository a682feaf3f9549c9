//! Whether `shade_hard` gives what it has to: the lower bound of the stored moments, in double precision.

use moment_shadows::Storage;

use super::harness::Difference;
use crate::error::LabError;
use crate::frame::Frame;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::{read_intensity, shade_parameters};
use crate::host::read_depth_samples;
use crate::judgement::Unfiltered;
use crate::truth::exact_bound::biased_bound;
use crate::truth::fragment::fragments;

/// One pixel in so many is compared; a prime, so that they fall on all columns.
const STRIDE: usize = 61;

/// The most that the mean over these pixels may be off. The bound jumps where a distribution has few depths, so single
/// pixels say little: there the rounding of the map decides.
const TOLERANCE: f64 = 0.01;

/// How far what a node wrote is from the bound of the moments that the storage biases, in the mean. `None` for targets
/// with several channels.
pub(super) fn difference(
    gpu: &Gpu,
    frame: &Frame,
    file: &GraphFile,
    intensity: &wgpu::Texture,
    storage: Storage,
) -> Result<Option<Difference>, LabError> {
    if intensity.format().components() != 1 {
        return Ok(None);
    }
    let parameters = shade_parameters(&frame.desc, file)?;
    let unfiltered = Unfiltered::of(gpu, frame, file)?;
    let camera_depth = read_depth_samples(gpu, &frame.surface.depth)?;
    let lookups: Vec<_> = fragments(&parameters, &camera_depth, frame.desc.map)
        .into_iter()
        .step_by(STRIDE)
        .collect();
    let bias = storage.moment_bias();
    let bounds = biased_bound(&unfiltered.depths, &unfiltered.taps, &lookups, bias);
    let found = read_intensity(gpu, intensity)?;
    let mut sum = 0.0;
    for (bound, found) in bounds.iter().zip(found.iter().step_by(STRIDE)) {
        let wanted = (bound / parameters.leak_reduction.full_shadow).min(1.0);
        sum += f64::from((wanted - found).abs());
    }
    Ok(Some(Difference {
        error: sum / bounds.len() as f64,
        tolerance: TOLERANCE,
    }))
}
