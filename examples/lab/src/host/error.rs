//! What can go wrong on the device.

use crate::error::LabError;
use crate::gpu::Gpu;

/// Runs `create` and turns what the device objects to into an error that names `what`.
pub(super) fn created<T>(gpu: &Gpu, what: &str, create: impl FnOnce() -> T) -> Result<T, LabError> {
    let memory = gpu.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let validation = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
    let result = create();
    let errors = [
        pollster::block_on(validation.pop()),
        pollster::block_on(memory.pop()),
    ];
    match errors.into_iter().flatten().next() {
        None => Ok(result),
        Some(error) => Err(LabError::refused(format!(
            "the device did not create {what}: {error}"
        ))),
    }
}

/// Checks the size of a two-dimensional texture.
pub(super) fn check_size(gpu: &Gpu, what: &str, size: [u32; 2]) -> Result<(), LabError> {
    let limit = gpu.device.limits().max_texture_dimension_2d;
    for edge in size {
        if edge == 0 || edge > limit {
            return Err(LabError::refused(format!(
                "{what} would have {edge} texels along an edge; this device allows 1 to {limit}"
            )));
        }
    }
    Ok(())
}
