//! SPIR-V as wgpu hands it to a Vulkan driver.

use std::borrow::Cow;
use std::collections::BTreeMap;

use naga::back::pipeline_constants::{PipelineConstantError, process_overrides};
use naga::back::spv;
use naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

use crate::error::LabError;

/// Versions of Vulkan that SPIR-V is written for, by the names that SPIRV-Tools know them by: the oldest that most devices
/// have, and the newest; with the version of SPIR-V that wgpu chooses.
pub(super) const TARGETS: [(&str, (u8, u8)); 2] = [("vulkan1.1", (1, 3)), ("vulkan1.3", (1, 6))];

/// wgpu's options for a device without optional features and without robust access to images and buffers.
pub(super) fn options(lang_version: (u8, u8)) -> spv::Options<'static> {
    let capabilities = [
        spv::Capability::Shader,
        spv::Capability::Matrix,
        spv::Capability::Sampled1D,
        spv::Capability::Image1D,
        spv::Capability::ImageQuery,
        spv::Capability::DerivativeControl,
        spv::Capability::StorageImageExtendedFormats,
        spv::Capability::SampledCubeArray,
        spv::Capability::SampleRateShading,
    ];
    spv::Options {
        lang_version,
        flags: spv::WriterFlags::LABEL_VARYINGS | spv::WriterFlags::FORCE_POINT_SIZE,
        capabilities: Some(capabilities.into_iter().collect()),
        bounds_check_policies: BoundsCheckPolicies {
            index: BoundsCheckPolicy::Restrict,
            buffer: BoundsCheckPolicy::Restrict,
            image_load: BoundsCheckPolicy::Restrict,
            binding_array: BoundsCheckPolicy::Unchecked,
        },
        ..spv::Options::default()
    }
}

/// A shader's module, parsed and validated by naga.
pub struct Compiled<'a> {
    name: &'a str,
    /// Values for its `override` declarations.
    constants: &'a BTreeMap<String, f64>,
    module: naga::Module,
    info: naga::valid::ModuleInfo,
}

impl<'a> Compiled<'a> {
    /// Parses and validates.
    pub fn new(
        name: &'a str,
        wgsl: &str,
        constants: &'a BTreeMap<String, f64>,
    ) -> Result<Self, LabError> {
        let failed = |reason: String| LabError::unsuitable(name, reason);
        // What a shader may ask for is checked per profile by the tests; here only that it translates.
        let capabilities =
            Capabilities::default() | Capabilities::STORAGE_TEXTURE_16BIT_NORM_FORMATS;
        let mut options = naga::front::wgsl::Options::new();
        options.capabilities = capabilities;
        let module = naga::front::wgsl::Frontend::new_with_options(options)
            .parse(wgsl)
            .map_err(|error| failed(error.emit_to_string(wgsl)))?;
        let info = Validator::new(ValidationFlags::all(), capabilities)
            .validate(&module)
            .map_err(|error| failed(error.emit_to_string(wgsl)))?;
        Ok(Self {
            name,
            constants,
            module,
            info,
        })
    }

    /// The entry points.
    pub fn entry_points(&self) -> impl Iterator<Item = &naga::EntryPoint> {
        self.module.entry_points.iter()
    }

    /// The module.
    #[must_use]
    pub fn module(&self) -> &naga::Module {
        &self.module
    }

    /// The SPIR-V of an entry point.
    pub fn spirv(
        &self,
        entry_point: &naga::EntryPoint,
        options: &spv::Options<'_>,
    ) -> Result<Vec<u32>, LabError> {
        let failed = |reason: String| self.failed(entry_point, reason);
        let pipeline = spv::PipelineOptions {
            shader_stage: entry_point.stage,
            entry_point: entry_point.name.clone(),
        };
        let (module, info) = self
            .of_entry_point(entry_point)
            .map_err(|error| failed(error.to_string()))?;
        spv::write_vec(&module, &info, options, Some(&pipeline))
            .map_err(|error| failed(error.to_string()))
    }

    /// The module without overrides and without what `entry_point` does not use.
    pub(super) fn of_entry_point(
        &self,
        entry_point: &naga::EntryPoint,
    ) -> Result<(Cow<'_, naga::Module>, Cow<'_, ModuleInfo>), Box<PipelineConstantError>> {
        let constants = self.constants.clone().into_iter().collect();
        let stage = Some((entry_point.stage, entry_point.name.as_str()));
        process_overrides(&self.module, &self.info, stage, &constants).map_err(Box::new)
    }

    pub(super) fn failed(&self, entry_point: &naga::EntryPoint, reason: String) -> LabError {
        let what = format!("{}, entry point {}", self.name, entry_point.name);
        LabError::unsuitable(what, reason)
    }
}
