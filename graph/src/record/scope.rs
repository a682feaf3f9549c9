//! Creation under error scopes: what fails is an error value.

use crate::{GraphError, GraphErrorKind};

/// Runs `create` at once; the device's verdict on it can be awaited on any thread.
pub(super) fn scoped<T>(
    device: &wgpu::Device,
    what: &str,
    create: impl FnOnce() -> T,
) -> impl Future<Output = Result<T, GraphError>> {
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    let internal = device.push_error_scope(wgpu::ErrorFilter::Internal);
    let validation = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let created = create();
    // Scopes are a stack per thread. All are popped before the first wait: another task that creates something meanwhile
    // would find the stack out of order.
    let (validation, internal, memory) = (validation.pop(), internal.pop(), memory.pop());
    verdict(created, what, [validation, internal], memory)
}

/// What was created, or what the device has against it.
async fn verdict<T, E: Future<Output = Option<wgpu::Error>>>(
    created: T,
    what: &str,
    [validation, internal]: [E; 2],
    memory: E,
) -> Result<T, GraphError> {
    let errors = [validation.await, internal.await];
    if memory.await.is_some() {
        let message = format!(
            "the device has no memory left for {what}; use smaller maps or a storage with fewer bits"
        );
        return Err(GraphError::new(GraphErrorKind::OutOfMemory, message));
    }
    match errors.into_iter().flatten().next() {
        None => Ok(created),
        Some(error) => {
            let message = format!("the device could not create {what}: {error}");
            Err(GraphError::new(GraphErrorKind::Device, message))
        }
    }
}

/// Whether the device still works.
///
/// A lost device reports nothing to error scopes, and what it is asked for is silently invalid. But a buffer that is to be
/// mapped from the start has no memory to map then.
pub(super) fn check_alive(device: &wgpu::Device) -> Result<(), GraphError> {
    let probe = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("moment-shadows/probe"),
        size: wgpu::MAP_ALIGNMENT,
        usage: wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: true,
    });
    match probe.get_mapped_range(..) {
        Ok(_) => Ok(()),
        Err(_) => Err(GraphError::new(
            GraphErrorKind::Lost,
            "the device was lost; open a new one and create everything anew",
        )),
    }
}
