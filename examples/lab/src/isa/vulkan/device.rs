//! Opening the device.

use core::ffi::CStr;

use ash::vk;

use super::refused;
use crate::error::LabError;
use crate::isa::driver::incomplete;

/// An open device of the driver that the environment names. It lasts as long as the process, which compiles for one chip.
pub(in crate::isa) struct NullDevice {
    pub(super) device: ash::Device,
    pub(super) executables: ash::khr::pipeline_executable_properties::Device,
    /// Holds the loader, and with it all functions.
    _entry: ash::Entry,
    /// The driver's name.
    pub(in crate::isa) driver_name: String,
    /// The driver's version, as it tells it.
    pub(in crate::isa) driver_version: String,
    /// The chip's name, as the driver tells it.
    pub(in crate::isa) chip_name: String,
}

/// What the driver lets one ask about compiled shaders.
const EXECUTABLES: &CStr = ash::khr::pipeline_executable_properties::NAME;
/// Robust access to images and buffers, which wgpu relies on where it is offered.
const ROBUSTNESS: &CStr = ash::ext::robustness2::NAME;

impl NullDevice {
    /// Opens the first device of the first driver.
    pub(in crate::isa) fn open() -> Result<Self, LabError> {
        // SAFETY: the loader is a system library whose initialisation has no requirements.
        let entry = unsafe { ash::Entry::load() }.map_err(|error| {
            let reason = format!("{error}; on Debian install it with `apt-get install libvulkan1`");
            LabError::unsuitable("the Vulkan loader", reason)
        })?;
        let application = vk::ApplicationInfo::default().api_version(vk::API_VERSION_1_3);
        let info = vk::InstanceCreateInfo::default().application_info(&application);
        // SAFETY: `info` and all it points to live through the call.
        let instance =
            unsafe { entry.create_instance(&info, None) }.map_err(refused("an instance"))?;
        let (device, [driver_name, driver_version, chip_name]) = open_device(&instance)?;
        Ok(Self {
            executables: ash::khr::pipeline_executable_properties::Device::new(&instance, &device),
            device,
            _entry: entry,
            driver_name,
            driver_version,
            chip_name,
        })
    }
}

/// A device, with the names of the driver, its version and the chip.
fn open_device(instance: &ash::Instance) -> Result<(ash::Device, [String; 3]), LabError> {
    // SAFETY: the instance is alive.
    let all = unsafe { instance.enumerate_physical_devices() }.map_err(refused("its devices"))?;
    let physical = *all
        .first()
        .ok_or_else(|| incomplete("a device, not even one without a GPU"))?;
    let mut driver = vk::PhysicalDeviceDriverProperties::default();
    let mut properties = vk::PhysicalDeviceProperties2::default().push_next(&mut driver);
    // SAFETY: the physical device is the instance's own, and the chain of structures lives through the call.
    unsafe { instance.get_physical_device_properties2(physical, &mut properties) };
    let chip = text(properties.properties.device_name_as_c_str());
    let names = [
        text(driver.driver_name_as_c_str()),
        text(driver.driver_info_as_c_str()),
        chip,
    ];

    let extensions = [EXECUTABLES.as_ptr(), ROBUSTNESS.as_ptr()];
    let queue = [vk::DeviceQueueCreateInfo::default().queue_priorities(&[1.0])];
    // What wgpu switches on as far as it bears on code.
    let features = vk::PhysicalDeviceFeatures::default()
        .robust_buffer_access(true)
        .shader_storage_image_extended_formats(true);
    let mut features13 = vk::PhysicalDeviceVulkan13Features::default()
        .dynamic_rendering(true)
        .robust_image_access(true)
        .shader_zero_initialize_workgroup_memory(true);
    let mut robustness = vk::PhysicalDeviceRobustness2FeaturesEXT::default()
        .robust_buffer_access2(true)
        .robust_image_access2(true);
    let mut executables = vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default()
        .pipeline_executable_info(true);
    let info = vk::DeviceCreateInfo::default()
        .queue_create_infos(&queue)
        .enabled_extension_names(&extensions)
        .enabled_features(&features)
        .push_next(&mut features13)
        .push_next(&mut robustness)
        .push_next(&mut executables);
    // SAFETY: the physical device is the instance's own, and `info` and all it points to live through the call.
    let device = unsafe { instance.create_device(physical, &info, None) }
        .map_err(refused("a device without a GPU"))?;
    Ok((device, names))
}

fn text(name: Result<&CStr, core::ffi::FromBytesUntilNulError>) -> String {
    name.map(|name| name.to_string_lossy().into_owned())
        .unwrap_or_default()
}
