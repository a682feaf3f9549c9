//! An open device.

use crate::error::HostError;

pub struct Gpu {
    pub device: wgpu::Device,
    pub queue: wgpu::Queue,
}

impl Gpu {
    /// Opens a device with core WebGPU.
    pub fn open() -> Result<Self, HostError> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
            backends: wgpu::Backends::VULKAN,
            // The names that nightshade gives things crash lavapipe 22.3.
            flags: wgpu::InstanceFlags::DISCARD_HAL_LABELS,
            ..wgpu::InstanceDescriptor::new_without_display_handle()
        });
        let device = async {
            let adapter = instance.request_adapter(&Default::default()).await;
            let adapter = adapter
                .map_err(|error| HostError::Device(format!("{error}; install a Vulkan driver")))?;
            let device = adapter.request_device(&Default::default()).await;
            device.map_err(|error| HostError::Device(error.to_string()))
        };
        let (device, queue) = pollster::block_on(device)?;
        Ok(Self { device, queue })
    }

    /// What a buffer holds.
    pub fn read(&self, buffer: &wgpu::Buffer) -> Result<Vec<u8>, HostError> {
        buffer.map_async(wgpu::MapMode::Read, .., |_| {});
        let waited = self.device.poll(wgpu::PollType::wait_indefinitely());
        waited.map_err(|error| HostError::Device(error.to_string()))?;
        let bytes = buffer.get_mapped_range(..).to_vec();
        buffer.unmap();
        Ok(bytes)
    }
}
