//! Creation under error scopes: what fails is an error value.

use core::task::{Context, Poll, Waker};

use crate::error::ensure;
use crate::{GraphError, GraphErrorKind};

/// Runs `create` at once; the device's verdict on it can be awaited on any thread.
pub(crate) fn scoped<T>(
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
        return Err(out_of_memory(what));
    }
    match errors.into_iter().flatten().next() {
        None => Ok(created),
        Some(error) => {
            let message = format!("the device could not create {what}: {error}");
            Err(GraphError::new(GraphErrorKind::Device, message))
        }
    }
}

fn out_of_memory(what: &str) -> GraphError {
    let message = format!(
        "the device has no memory left for {what}; use smaller maps or a storage with fewer bits"
    );
    GraphError::new(GraphErrorKind::OutOfMemory, message)
}

/// Whether the device still works.
///
/// A lost device reports nothing to error scopes, and what it is asked for is silently invalid. But a buffer that is to be
/// mapped from the start has no memory to map then.
pub(super) async fn check_alive(device: &wgpu::Device) -> Result<(), GraphError> {
    const LABEL: &str = "moment-shadows/probe";
    let create = || {
        let probe = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(LABEL),
            size: wgpu::MAP_ALIGNMENT,
            // Without a staging buffer, whose copy is recorded when the probe is dropped.
            usage: wgpu::BufferUsages::MAP_WRITE,
            mapped_at_creation: true,
        });
        probe.get_mapped_range(..).is_ok()
    };
    let works = scoped(device, LABEL, create).await?;
    ensure(
        works,
        GraphErrorKind::Lost,
        || "the device was lost; open a new one and create everything anew",
    )
}

/// Writes to a device's buffers within a frame, where nothing can be waited for.
///
/// A browser says only later that it had no memory: there that goes to the host's own handler.
pub(crate) fn written(
    device: &wgpu::Device,
    what: &str,
    write: impl FnOnce(),
) -> Result<(), GraphError> {
    if cfg!(target_arch = "wasm32") {
        write();
        return Ok(());
    }
    let memory = device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
    write();
    let verdict = core::pin::pin!(memory.pop());
    match verdict.poll(&mut Context::from_waker(Waker::noop())) {
        Poll::Ready(Some(_)) => Err(out_of_memory(what)),
        Poll::Ready(None) | Poll::Pending => Ok(()),
    }
}
