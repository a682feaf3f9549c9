//! Compiling the shaders of the table for the chip that the environment names.

use super::chip::Chip;
use super::driver::{Driver, loaded_sha256};
use super::spirv::SpirvModule;
use super::subjects::Subject;
use super::vulkan::{Executable, NullDevice};
use crate::error::LabError;
use crate::shaders;

/// The driver, opened for a chip.
pub(super) struct Compiler {
    device: NullDevice,
    /// The driver's name, version and hash.
    pub(super) driver: Driver,
}

/// A compiled shader.
pub(super) struct Compiled {
    pub(super) executable: Executable,
    /// Outputs of an invocation.
    pub(super) outputs: f64,
}

impl Compiler {
    /// Opens the driver that the environment names, and makes sure that it compiles for `chip`.
    pub(super) fn open(chip: Chip) -> Result<Self, LabError> {
        let device = NullDevice::open()?;
        if !device.chip_name.to_lowercase().contains(chip.name()) {
            let reason = format!(
                "it gave '{}' instead of {chip}; this version of it may not know the chip, or may only use the GPU that is there",
                device.chip_name
            );
            return Err(LabError::unsuitable("the driver", reason));
        }
        let driver = Driver {
            name: device.driver_name.clone(),
            version: device.driver_version.clone(),
            sha256: loaded_sha256()?,
        };
        Ok(Self { device, driver })
    }

    pub(super) fn compile(&self, subject: &Subject) -> Result<Compiled, LabError> {
        let shader = shaders::Compiled::new(&subject.name, &subject.wgsl, &subject.constants)?;
        let write =
            |stage, entry_point| SpirvModule::new(&subject.name, &shader, stage, entry_point);
        let texels = f64::from(subject.texels_per_workgroup);
        if let Some(target) = subject.target {
            let vertex = write(naga::ShaderStage::Vertex, VERTEX_ENTRY_POINT)?;
            let module = write(naga::ShaderStage::Fragment, &subject.entry_point)?;
            return Ok(Compiled {
                executable: self
                    .device
                    .compile(&module, Some((&vertex, target, subject.targets)))?,
                outputs: texels,
            });
        }
        let module = write(naga::ShaderStage::Compute, &subject.entry_point)?;
        Ok(Compiled {
            executable: self.device.compile(&module, None)?,
            outputs: texels / f64::from(module.workgroup.max(1)),
        })
    }
}

/// The vertex stage of every fullscreen pass.
const VERTEX_ENTRY_POINT: &str = "fullscreen";
