//! Shaders against what their nodes declare: the text is parsed and validated, and every binding compared.

use std::collections::BTreeMap;

use moment_shadows::Profile;
use naga::valid::{
    Capabilities as NagaCapabilities, FunctionInfo, ModuleInfo, ValidationFlags, Validator,
};
use naga::{AddressSpace, ImageClass, ImageDimension, ScalarKind, ShaderStage, TypeInner};

use crate::{
    GraphError, GraphErrorKind, PlannedBinding, PlannedBindingResource, PlannedPass,
    PlannedResource, PlannedWork, SampleType,
};

/// Parsed shaders by their text, so that passes that share one parse it once.
#[derive(Default)]
pub(super) struct Shaders {
    parsed: BTreeMap<String, (naga::Module, ModuleInfo)>,
}

impl Shaders {
    /// Compares a pass with its shader.
    pub(super) fn check(
        &mut self,
        pass: &PlannedPass,
        resources: &[PlannedResource],
        profile: Profile,
        bind_group: u32,
    ) -> Result<(), GraphError> {
        if matches!(pass.work, PlannedWork::Host { .. }) {
            return Ok(());
        }
        let (module, info) = match self.parsed.get(&pass.wgsl) {
            Some(parsed) => parsed,
            None => {
                let parsed = parse(&pass.wgsl, profile)?;
                self.parsed.entry(pass.wgsl.clone()).or_insert(parsed)
            }
        };
        if matches!(pass.work, PlannedWork::Fullscreen { .. }) {
            let vertex =
                info.get_entry_point(entry_point(module, "fullscreen", ShaderStage::Vertex)?);
            let used = |(handle, variable): &(
                naga::Handle<naga::GlobalVariable>,
                &naga::GlobalVariable,
            )| { variable.binding.is_some() && !vertex[*handle].is_empty() };
            if let Some((_, variable)) = module.global_variables.iter().find(used) {
                return Err(mismatch(format!(
                    "the vertex entry point 'fullscreen' uses '{}'; bindings are the fragment entry point's",
                    variable.name.as_deref().unwrap_or("?")
                )));
            }
        }
        check_constants(module, pass)?;
        let stage = match pass.work {
            PlannedWork::Compute { .. } => ShaderStage::Compute,
            _ => ShaderStage::Fragment,
        };
        let index = entry_point(module, &pass.entry_point, stage)?;
        let uses = info.get_entry_point(index);
        let mut declared: BTreeMap<u32, &PlannedBinding> = BTreeMap::new();
        for binding in &pass.bindings {
            if declared.insert(binding.binding, binding).is_some() {
                return Err(mismatch(format!(
                    "the node declares binding {} twice",
                    binding.binding
                )));
            }
        }
        for (handle, variable) in module.global_variables.iter() {
            let Some(binding) = &variable.binding else {
                continue;
            };
            if uses[handle].is_empty() {
                continue;
            }
            let name = variable.name.as_deref().unwrap_or("?");
            if binding.group != bind_group {
                return Err(mismatch(format!(
                    "'{name}' is in bind group {}, but the plan has group {bind_group}; take the group from the specialisation",
                    binding.group
                )));
            }
            let planned = declared.remove(&binding.binding).ok_or_else(|| {
                mismatch(format!(
                    "the shader uses binding {} ('{name}'), which the node does not declare",
                    binding.binding
                ))
            })?;
            let actual = &module.types[variable.ty].inner;
            if let Some(expected) = difference(module, variable.space, actual, planned, resources) {
                return Err(mismatch(format!(
                    "binding {} ('{name}') is not {expected}, which the node declares",
                    binding.binding
                )));
            }
        }
        check_filtering(module, uses, pass, resources)?;
        match declared.keys().next() {
            Some(binding) => Err(mismatch(format!(
                "the node declares binding {binding}, which the shader does not use"
            ))),
            None => Ok(()),
        }
    }
}

fn mismatch(message: String) -> GraphError {
    GraphError::new(GraphErrorKind::Shader, message)
}

fn parse(wgsl: &str, profile: Profile) -> Result<(naga::Module, ModuleInfo), GraphError> {
    let module = naga::front::wgsl::parse_str(wgsl).map_err(|error| {
        mismatch(format!(
            "the shader does not parse:\n{}",
            error.emit_to_string(wgsl)
        ))
    })?;
    // What every WebGPU device has, though naga asks for it: sample shading, cube arrays, packing of 16-bit floats.
    let core = NagaCapabilities::MULTISAMPLED_SHADING
        | NagaCapabilities::CUBE_ARRAY_TEXTURES
        | NagaCapabilities::SHADER_FLOAT16_IN_FLOAT32;
    let capabilities = match profile {
        Profile::WebgpuCore => core,
        Profile::Native | Profile::NativeAdapter => {
            core | NagaCapabilities::STORAGE_TEXTURE_16BIT_NORM_FORMATS
        }
    };
    let info = Validator::new(ValidationFlags::all(), capabilities)
        .validate(&module)
        .map_err(|error| {
            mismatch(format!(
                "the shader is not valid:\n{}",
                error.emit_to_string(wgsl)
            ))
        })?;
    Ok((module, info))
}

fn entry_point(module: &naga::Module, name: &str, stage: ShaderStage) -> Result<usize, GraphError> {
    module
        .entry_points
        .iter()
        .position(|entry| entry.name == name && entry.stage == stage)
        .ok_or_else(|| mismatch(format!("the shader has no {stage:?} entry point '{name}'")))
}

/// A texture that the shader samples with a filtering sampler has a format that the device can filter.
fn check_filtering(
    module: &naga::Module,
    uses: &FunctionInfo,
    pass: &PlannedPass,
    resources: &[PlannedResource],
) -> Result<(), GraphError> {
    let planned = |variable: naga::Handle<naga::GlobalVariable>| {
        let index = module.global_variables[variable].binding?.binding;
        let mut bindings = pass.bindings.iter();
        bindings.find(|planned| planned.binding == index)
    };
    for key in &uses.sampling_set {
        let (Some(image), Some(sampler)) = (planned(key.image), planned(key.sampler)) else {
            continue;
        };
        if let PlannedBindingResource::Texture {
            resource,
            sample: SampleType::Unfilterable,
            ..
        } = image.resource
            && matches!(
                sampler.resource,
                PlannedBindingResource::Sampler {
                    filtering: true,
                    ..
                }
            )
        {
            return Err(GraphError::new(
                GraphErrorKind::Capability,
                format!(
                    "binding {} samples '{}', {}, which this device cannot filter; load its texels and blend them in the \
                     shader",
                    image.binding, resources[resource].name, resources[resource].desc
                ),
            ));
        }
    }
    Ok(())
}

/// Every constant is an `override` of the shader, and every `override` without a value has a constant.
fn check_constants(module: &naga::Module, pass: &PlannedPass) -> Result<(), GraphError> {
    // An override with an `@id` is known by that number.
    let key = |constant: &naga::Override| match constant.id {
        Some(id) => Some(id.to_string()),
        None => constant.name.clone(),
    };
    let overrides = || module.overrides.iter().map(|(_, constant)| constant);
    for name in pass.constants.keys() {
        if overrides().all(|constant| key(constant).as_ref() != Some(name)) {
            return Err(mismatch(format!(
                "the node gives the constant '{name}', which is no override of the shader"
            )));
        }
    }
    let open = overrides()
        .filter(|constant| constant.init.is_none())
        .filter_map(key);
    match open
        .into_iter()
        .find(|name| !pass.constants.contains_key(name))
    {
        None => Ok(()),
        Some(name) => Err(mismatch(format!(
            "the shader's override '{name}' has no value; the node has to give one among its constants"
        ))),
    }
}

/// What the node declares, if the shader's variable is something else.
fn difference(
    module: &naga::Module,
    space: AddressSpace,
    actual: &TypeInner,
    planned: &PlannedBinding,
    resources: &[PlannedResource],
) -> Option<String> {
    let (matches, expected) = match &planned.resource {
        PlannedBindingResource::Parameters { size, .. } => (
            space == AddressSpace::Uniform && actual.size(module.to_ctx()) == *size,
            format!("a uniform struct of {size} bytes"),
        ),
        PlannedBindingResource::Regions { size, .. } => (
            space == AddressSpace::Uniform && actual.size(module.to_ctx()) == *size,
            format!("a uniform array of regions of {size} bytes"),
        ),
        PlannedBindingResource::Buffer { writable, resource } => {
            let size = resources[*resource].desc.bytes();
            (
                matches!(space, AddressSpace::Storage { access }
                    if access.contains(naga::StorageAccess::STORE) == *writable)
                    && u64::from(actual.size(module.to_ctx())) <= size,
                format!(
                    "a {} storage buffer of at most {size} bytes",
                    if *writable { "writable" } else { "read-only" }
                ),
            )
        }
        PlannedBindingResource::Sampler { .. } => (
            matches!(actual, TypeInner::Sampler { comparison: false }),
            "a sampler".to_owned(),
        ),
        PlannedBindingResource::ComparisonSampler { .. } => (
            matches!(actual, TypeInner::Sampler { comparison: true }),
            "a comparison sampler".to_owned(),
        ),
        PlannedBindingResource::StorageTexture { resource, .. } => {
            let format = resources[*resource]
                .desc
                .texture()
                .map(|texture| texture.format);
            let name = format.map_or("", |format| format.name());
            let matches = match actual {
                TypeInner::Image {
                    dim: ImageDimension::D2,
                    arrayed: false,
                    class: ImageClass::Storage { format, access },
                } => {
                    *access == naga::StorageAccess::STORE
                        && format!("{format:?}").to_lowercase() == name
                }
                _ => false,
            };
            (
                matches,
                format!("a two-dimensional storage texture of format {name}, written only"),
            )
        }
        PlannedBindingResource::Texture {
            one_layer,
            sample,
            multisampled,
            ..
        } => {
            let class = match sample {
                SampleType::Depth => ImageClass::Depth {
                    multi: *multisampled,
                },
                SampleType::Filterable | SampleType::Unfilterable => ImageClass::Sampled {
                    kind: ScalarKind::Float,
                    multi: *multisampled,
                },
                SampleType::Integer => ImageClass::Sampled {
                    kind: ScalarKind::Uint,
                    multi: *multisampled,
                },
            };
            let matches = match actual {
                TypeInner::Image {
                    dim: ImageDimension::D2,
                    arrayed,
                    class: actual,
                } => *arrayed != *one_layer && *actual == class,
                _ => false,
            };
            let kind = match sample {
                SampleType::Depth => "depth",
                SampleType::Integer => "u32",
                _ => "float",
            };
            let shape = match (one_layer, multisampled) {
                (_, true) => "multisampled two-dimensional",
                (true, false) => "two-dimensional",
                (false, false) => "two-dimensional array",
            };
            (matches, format!("a {shape} {kind} texture"))
        }
    };
    (!matches).then_some(expected)
}
