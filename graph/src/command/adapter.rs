//! `moment-shadows adapter`: the graphics adapter that graphs run on.

use std::process::ExitCode;

use super::CommandError;

/// Opens the best adapter and prints it.
///
/// # Errors
/// [`CommandError::NoAdapter`], [`CommandError::NoDevice`], or [`CommandError::Output`].
#[cfg(feature = "wgpu")]
pub fn run() -> Result<ExitCode, CommandError> {
    let adapter = best()?;
    let info = adapter.get_info();
    let device = now(adapter.request_device(&wgpu::DeviceDescriptor::default()));
    device.map_err(|error| CommandError::NoDevice {
        adapter: info.name.clone(),
        reason: error.to_string(),
    })?;
    super::output::print(format_args!(
        "{} ({:?}, {:?}, {})",
        info.name, info.device_type, info.backend, info.driver_info
    ))?;
    Ok(ExitCode::SUCCESS)
}

/// Says how to get a command that knows adapters.
///
/// # Errors
/// [`CommandError::WithoutWgpu`], always.
#[cfg(not(feature = "wgpu"))]
pub fn run() -> Result<ExitCode, CommandError> {
    Err(CommandError::WithoutWgpu)
}

/// The best adapter: hardware before software. OpenGL does not count: wgpu cannot load depth textures through it, so no graph
/// runs there, and a machine with a driver for nothing else has no adapter.
///
/// # Errors
/// [`CommandError::NoAdapter`].
#[cfg(feature = "wgpu")]
pub fn best() -> Result<wgpu::Adapter, CommandError> {
    let backends = wgpu::Backends::VULKAN | wgpu::Backends::METAL | wgpu::Backends::DX12;
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends,
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let adapters = now(instance.enumerate_adapters(backends));
    let best = adapters
        .into_iter()
        .min_by_key(|adapter| match adapter.get_info().device_type {
            wgpu::DeviceType::DiscreteGpu => 0,
            wgpu::DeviceType::IntegratedGpu => 1,
            wgpu::DeviceType::VirtualGpu => 2,
            wgpu::DeviceType::Other => 3,
            wgpu::DeviceType::Cpu => 4,
        });
    best.ok_or(CommandError::NoAdapter)
}

/// What a future of wgpu gives. On these backends all are ready at once.
#[cfg(feature = "wgpu")]
fn now<T>(future: impl Future<Output = T>) -> T {
    use std::task::{Context, Poll, Waker};
    let mut future = std::pin::pin!(future);
    loop {
        if let Poll::Ready(value) = future
            .as_mut()
            .poll(&mut Context::from_waker(Waker::noop()))
        {
            return value;
        }
        std::thread::yield_now();
    }
}
