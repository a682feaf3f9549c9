//! From WGSL to SPIR-V, as wgpu does it on Vulkan, and what a pipeline layout has to hold.

use std::collections::BTreeMap;

use naga::back::spv;
use naga::proc::{BoundsCheckPolicies, BoundsCheckPolicy};

use super::error::IsaError;

/// A shader as the driver takes it.
pub(super) struct SpirvModule {
    /// The code of one entry point.
    pub(super) words: Vec<u32>,
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
    pub(super) kind: BoundKind,
}

/// What is bound.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum BoundKind {
    /// With a dynamic offset, as plans are recorded.
    Uniform,
    Buffer,
    Texture,
    StorageTexture,
    Sampler,
}

/// Parses and validates `wgsl`, and writes the named entry point.
pub(super) fn compile(
    shader: &str,
    wgsl: &str,
    stage: naga::ShaderStage,
    entry_point: &str,
    constants: &BTreeMap<String, f64>,
) -> Result<SpirvModule, IsaError> {
    let failed = |reason: String| IsaError::Shader {
        shader: shader.to_owned(),
        reason,
    };
    let module =
        naga::front::wgsl::parse_str(wgsl).map_err(|error| failed(error.emit_to_string(wgsl)))?;
    let info = naga::valid::Validator::new(
        naga::valid::ValidationFlags::all(),
        naga::valid::Capabilities::STORAGE_TEXTURE_16BIT_NORM_FORMATS,
    )
    .validate(&module)
    .map_err(|error| failed(error.emit_to_string(wgsl)))?;
    let bindings = bindings(&module).map_err(failed)?;
    let workgroup = module
        .entry_points
        .iter()
        .find(|entry| entry.name == entry_point && entry.stage == stage)
        .map(|entry| entry.workgroup_size.iter().product())
        .ok_or_else(|| failed(format!("it has no entry point `{entry_point}`")))?;
    let constants = constants
        .iter()
        .map(|(name, &value)| (name.clone(), value))
        .collect();
    let (module, info) = naga::back::pipeline_constants::process_overrides(
        &module,
        &info,
        Some((stage, entry_point)),
        &constants,
    )
    .map_err(|error| failed(error.to_string()))?;
    let words = spv::write_vec(
        &module,
        &info,
        &options(&bindings),
        Some(&spv::PipelineOptions {
            shader_stage: stage,
            entry_point: entry_point.to_owned(),
        }),
    )
    .map_err(|error| failed(error.to_string()))?;
    Ok(SpirvModule {
        words,
        bindings,
        workgroup,
    })
}

/// What wgpu sets for a Vulkan 1.3 driver with robust access to images and buffers, in a release build.
fn options(bindings: &[Bound]) -> spv::Options<'static> {
    let binding_map = bindings
        .iter()
        .map(|bound| {
            (
                naga::ResourceBinding {
                    group: bound.group,
                    binding: bound.binding,
                },
                spv::BindingInfo {
                    descriptor_set: bound.group,
                    binding: bound.binding,
                    binding_array_size: None,
                },
            )
        })
        .collect();
    spv::Options {
        lang_version: (1, 6),
        flags: spv::WriterFlags::LABEL_VARYINGS | spv::WriterFlags::FORCE_POINT_SIZE,
        fake_missing_bindings: false,
        binding_map,
        bounds_check_policies: BoundsCheckPolicies {
            index: BoundsCheckPolicy::Restrict,
            buffer: BoundsCheckPolicy::Unchecked,
            image_load: BoundsCheckPolicy::Unchecked,
            binding_array: BoundsCheckPolicy::Unchecked,
        },
        zero_initialize_workgroup_memory: spv::ZeroInitializeWorkgroupMemoryMode::Native,
        force_loop_bounding: true,
        use_storage_input_output_16: false,
        debug_info: None,
        ..spv::Options::default()
    }
}

fn bindings(module: &naga::Module) -> Result<Vec<Bound>, String> {
    let mut bindings = Vec::new();
    for (_, variable) in module.global_variables.iter() {
        let Some(binding) = &variable.binding else {
            continue;
        };
        let kind = match variable.space {
            naga::AddressSpace::Uniform => BoundKind::Uniform,
            naga::AddressSpace::Storage { .. } => BoundKind::Buffer,
            _ => match module.types[variable.ty].inner {
                naga::TypeInner::Sampler { .. } => BoundKind::Sampler,
                naga::TypeInner::Image {
                    class: naga::ImageClass::Storage { .. },
                    ..
                } => BoundKind::StorageTexture,
                naga::TypeInner::Image { .. } => BoundKind::Texture,
                _ => {
                    let name = variable.name.as_deref().unwrap_or("a variable");
                    return Err(format!(
                        "`{name}` is bound to what the ISA table knows no layout for"
                    ));
                }
            },
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
