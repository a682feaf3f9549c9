//! Creation under error scopes: what fails is an error value.

use super::RecordError;

/// Runs `create` and waits for the device's verdict on it.
pub(super) async fn scoped<T>(
    device: &wgpu::Device,
    what: &str,
    create: impl FnOnce() -> T,
) -> Result<T, RecordError> {
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let internal = device.push_error_scope(wgpu::ErrorFilter::Internal);
    let validation = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let created = create();
    // Scopes are a stack: the last one is popped first. Popping takes effect at once; the futures only carry the answer.
    let pops = [validation.pop().await, internal.pop().await];
    if memory.pop().await.is_some() {
        return Err(RecordError::OutOfMemory {
            what: what.to_owned(),
        });
    }
    match pops.into_iter().flatten().next() {
        None => Ok(created),
        Some(error) => Err(RecordError::Device {
            what: what.to_owned(),
            reason: error.to_string(),
        }),
    }
}
