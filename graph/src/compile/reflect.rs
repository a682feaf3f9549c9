//! Shaders against what their nodes declare: the text is parsed and validated, and every binding compared.

use std::collections::BTreeMap;

use moment_shadows::Profile;
use naga::valid::{Capabilities as NagaCapabilities, ModuleInfo, ValidationFlags, Validator};
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
            entry_point(module, "fullscreen", ShaderStage::Vertex)?;
        }
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
    let capabilities = match profile {
        Profile::WebgpuCore => NagaCapabilities::empty(),
        Profile::Native | Profile::NativeAdapter => {
            NagaCapabilities::STORAGE_TEXTURE_16BIT_NORM_FORMATS
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
        PlannedBindingResource::Buffer { writable, .. } => (
            matches!(space, AddressSpace::Storage { access }
                if access.contains(naga::StorageAccess::STORE) == *writable),
            format!(
                "a {} storage buffer",
                if *writable { "writable" } else { "read-only" }
            ),
        ),
        PlannedBindingResource::Sampler { .. } => (
            matches!(actual, TypeInner::Sampler { comparison: false }),
            "a sampler".to_owned(),
        ),
        PlannedBindingResource::StorageTexture { resource } => {
            let format = resources[*resource]
                .desc
                .texture()
                .map(|texture| texture.format);
            let name = format.map_or("", |format| format.name());
            let matches = match actual {
                TypeInner::Image {
                    dim: ImageDimension::D2,
                    arrayed: false,
                    class: ImageClass::Storage { format, .. },
                } => format!("{format:?}").to_lowercase() == name,
                _ => false,
            };
            (
                matches,
                format!("a two-dimensional storage texture of format {name}"),
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
