//! SPIR-V as wgpu writes it for the driver, and what a pipeline layout has to hold.

use std::ffi::CString;

use ash::vk;
use naga::back::spv;
use naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};

use crate::error::LabError;
use crate::shaders::Compiled;

/// A shader as the driver takes it.
pub(super) struct SpirvModule {
    /// The code of one entry point.
    pub(super) words: Vec<u32>,
    pub(super) entry_point: CString,
    /// Every global variable with a binding.
    pub(super) bindings: Vec<Bound>,
    /// Invocations of a workgroup; 0 for other stages.
    pub(super) workgroup: u32,
}

/// A binding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Bound {
    pub(super) group: u32,
    pub(super) binding: u32,
    pub(super) kind: vk::DescriptorType,
}

impl SpirvModule {
    /// Writes the named entry point of the shader with the name `shader`.
    pub(super) fn new(
        shader: &str,
        compiled: &Compiled<'_>,
        stage: naga::ShaderStage,
        entry_point: &str,
    ) -> Result<Self, LabError> {
        let failed = |reason: String| LabError::unsuitable(format!("shader '{}'", shader), reason);
        let entry = compiled
            .entry_points()
            .find(|entry| entry.name == entry_point && entry.stage == stage)
            .ok_or_else(|| failed(format!("it has no entry point `{entry_point}`")))?;
        Ok(Self {
            words: compiled.spirv(entry, &options())?,
            entry_point: CString::new(entry_point).map_err(|error| failed(error.to_string()))?,
            bindings: bindings(compiled.module()).map_err(failed)?,
            workgroup: entry.workgroup_size.iter().product(),
        })
    }
}

/// What wgpu sets for a Vulkan 1.3 driver with robust access to images and buffers, in a release build.
fn options() -> spv::Options<'static> {
    spv::Options {
        lang_version: (1, 6),
        flags: spv::WriterFlags::LABEL_VARYINGS | spv::WriterFlags::FORCE_POINT_SIZE,
        bounds_check_policies: BoundsCheckPolicies {
            index: BoundsCheckPolicy::Restrict,
            buffer: BoundsCheckPolicy::Unchecked,
            image_load: BoundsCheckPolicy::Unchecked,
            binding_array: BoundsCheckPolicy::Unchecked,
        },
        zero_initialize_workgroup_memory: spv::ZeroInitializeWorkgroupMemoryMode::Native,
        force_loop_bounding: true,
        use_storage_input_output_16: false,
        ..spv::Options::default()
    }
}

fn bindings(module: &naga::Module) -> Result<Vec<Bound>, String> {
    let mut bindings = Vec::new();
    for (_, variable) in module.global_variables.iter() {
        let Some(binding) = &variable.binding else {
            continue;
        };
        let kind = match (variable.space, &module.types[variable.ty].inner) {
            // With a dynamic offset, as plans are recorded.
            (naga::AddressSpace::Uniform, _) => vk::DescriptorType::UNIFORM_BUFFER_DYNAMIC,
            (naga::AddressSpace::Storage { .. }, _) => vk::DescriptorType::STORAGE_BUFFER,
            (_, naga::TypeInner::Sampler { .. }) => vk::DescriptorType::SAMPLER,
            (_, naga::TypeInner::Image { class, .. }) => match class {
                naga::ImageClass::Storage { .. } => vk::DescriptorType::STORAGE_IMAGE,
                _ => vk::DescriptorType::SAMPLED_IMAGE,
            },
            _ => {
                let name = variable.name.as_deref().unwrap_or("a variable");
                return Err(format!(
                    "`{name}` is bound to what the ISA table knows no layout for"
                ));
            }
        };
        bindings.push(Bound {
            group: binding.group,
            binding: binding.binding,
            kind,
        });
    }
    bindings.sort_unstable();
    Ok(bindings)
}
