//! Shaders against what their nodes describe: the text is parsed and validated, every variable found by its name and compared.

use std::collections::BTreeMap;

use moment_shadows::{Profile, nearest};
use naga::valid::{
    Capabilities as NagaCapabilities, FunctionInfo, ModuleInfo, ValidationFlags, Validator,
};
use naga::{AddressSpace, ImageClass, ImageDimension, ScalarKind, ShaderStage, TypeInner};

use super::fields;
use super::passes::VERTEX_ENTRY_POINT;
use crate::{
    BindingLayout, BufferKind, Capabilities, GraphError, GraphErrorKind, ParameterLayout, Pass,
    PlannedBinding, PlannedBindingResource, PlannedPass, PlannedResource, PlannedWork, SampleType,
    SamplerKind, ViewDimension,
};

/// The shaders of a plan, each once.
#[derive(Default)]
pub(super) struct Shaders {
    texts: Vec<String>,
    parsed: Vec<(naga::Module, ModuleInfo)>,
}

impl Shaders {
    /// Compares a pass with its shader, and gives its bindings the numbers that the shader's variables have.
    pub(super) fn bind(
        &mut self,
        described: &Pass,
        pass: &mut PlannedPass,
        resources: &[PlannedResource],
        capabilities: &Capabilities,
    ) -> Result<(), GraphError> {
        let bind_group = capabilities.bind_group;
        if matches!(pass.work, PlannedWork::Host { .. }) {
            for (number, binding) in (0..).zip(&mut pass.bindings) {
                binding.binding = number;
            }
            return Ok(());
        }
        let known = self.texts.iter().position(|text| *text == described.wgsl);
        let shader = match known {
            Some(known) => known,
            None => {
                self.parsed
                    .push(parse(&described.wgsl, capabilities.profile)?);
                self.texts.push(described.wgsl.clone());
                self.texts.len() - 1
            }
        };
        pass.shader = Some(shader);
        let (module, info) = &self.parsed[shader];
        let mut stage = ShaderStage::Compute;
        if matches!(pass.work, PlannedWork::Fullscreen { .. }) {
            stage = ShaderStage::Fragment;
            let vertex = entry_point(module, VERTEX_ENTRY_POINT, ShaderStage::Vertex)?;
            if let Some((name, ..)) = variables(module, info.get_entry_point(vertex)).next() {
                return Err(mismatch(format!(
                    "the vertex entry point 'fullscreen' uses '{name}'; bindings are the fragment entry point's"
                )));
            }
        }
        check_constants(module, pass)?;
        let uses = info.get_entry_point(entry_point(module, &pass.entry_point, stage)?);
        let mut open: BTreeMap<&str, &mut PlannedBinding> = BTreeMap::new();
        for (binding, planned) in described.bindings.iter().zip(&mut pass.bindings) {
            if open.insert(&binding.variable, planned).is_some() {
                return Err(mismatch(format!(
                    "the node describes the variable '{}' twice",
                    binding.variable
                )));
            }
        }
        for (name, variable, number) in variables(module, uses) {
            if number.group != bind_group {
                return Err(mismatch(format!(
                    "'{name}' is in bind group {}, but the plan has group {bind_group}; take the group from the specialisation",
                    number.group
                )));
            }
            let Some(planned) = open.remove(name) else {
                return Err(mismatch(format!(
                    "the shader uses the variable '{name}', which the node does not describe; what it describes and the \
                     shader does not use: {}",
                    among(name, open.keys().copied())
                )));
            };
            planned.binding = number.binding;
            let actual = &module.types[variable.ty].inner;
            if let Some(expected) = difference(module, variable.space, actual, planned, resources) {
                return Err(mismatch(format!(
                    "the variable '{name}' is not {expected}, which the node describes"
                )));
            }
            if let BindingLayout::Buffer {
                min_binding_size, ..
            } = &mut planned.layout
            {
                *min_binding_size = actual.size(module.to_ctx());
            }
        }
        if let Some(name) = open.keys().next() {
            let used = variables(module, uses).map(|(name, ..)| name);
            return Err(mismatch(format!(
                "the node describes the variable '{name}', which the entry point '{}' does not use; what it uses: {}",
                pass.entry_point,
                among(name, used)
            )));
        }
        pass.bindings.sort_by_key(|planned| planned.binding);
        check_filtering(module, uses, pass, resources)
    }

    /// The members of every uniform struct, by its name in the shaders that use it.
    pub(super) fn add_fields(&self, layout: &mut ParameterLayout) {
        for block in &mut layout.blocks {
            let mut modules = self.parsed.iter().map(|(module, _)| module);
            let fields = modules.find_map(|module| fields::of(module, &block.name, block.size));
            block.fields = fields.unwrap_or_default();
        }
    }

    /// The texts, by the numbers that passes have them by.
    pub(super) fn into_texts(self) -> Vec<String> {
        self.texts
    }
}

/// The names nearest to one.
fn among<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> String {
    match nearest(name, known) {
        none if none.is_empty() => "nothing".to_owned(),
        nearest => nearest,
    }
}

/// The bound variables that an entry point uses, with their names and places.
fn variables<'m>(
    module: &'m naga::Module,
    uses: &'m FunctionInfo,
) -> impl Iterator<Item = (&'m str, &'m naga::GlobalVariable, naga::ResourceBinding)> {
    module
        .global_variables
        .iter()
        .filter(|(handle, _)| !uses[*handle].is_empty())
        .filter_map(|(_, variable)| Some((variable.name.as_deref()?, variable, variable.binding?)))
}

/// The binding numbers of a shader's variables, by name.
pub(crate) fn numbers(wgsl: &str) -> Result<BTreeMap<String, u32>, GraphError> {
    let module = module(wgsl)?;
    let numbers = module
        .global_variables
        .iter()
        .filter_map(|(_, variable)| Some((variable.name.clone()?, variable.binding?.binding)));
    Ok(numbers.collect())
}

fn mismatch(message: String) -> GraphError {
    GraphError::new(GraphErrorKind::Shader, message)
}

fn module(wgsl: &str) -> Result<naga::Module, GraphError> {
    naga::front::wgsl::parse_str(wgsl).map_err(|error| {
        mismatch(format!(
            "the shader does not parse:\n{}",
            error.emit_to_string(wgsl)
        ))
    })
}

fn parse(wgsl: &str, profile: Profile) -> Result<(naga::Module, ModuleInfo), GraphError> {
    let module = module(wgsl)?;
    // What every WebGPU device has, though naga asks for it: sample shading, cube arrays, packing of 16-bit floats.
    let core = NagaCapabilities::MULTISAMPLED_SHADING
        | NagaCapabilities::CUBE_ARRAY_TEXTURES
        | NagaCapabilities::SHADER_FLOAT16_IN_FLOAT32;
    let capabilities = match profile {
        Profile::WebgpuCore => core,
        Profile::Native | Profile::NativeAdapter | Profile::WebgpuTier1 => {
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
        if let (Some(image), Some(sampler)) = (planned(key.image), planned(key.sampler))
            && let BindingLayout::Texture {
                sample_type: SampleType::UnfilterableFloat,
                ..
            } = image.layout
            && let BindingLayout::Sampler {
                ty: SamplerKind::Filtering,
            } = sampler.layout
            && let PlannedBindingResource::Texture { resource, .. } = image.resource
        {
            let name = module.global_variables[key.image].name.as_deref();
            let PlannedResource { name: of, desc, .. } = &resources[resource];
            return Err(GraphError::new(
                GraphErrorKind::Capability,
                format!(
                    "'{}' samples '{of}', {desc}, which this device cannot filter; load its texels and blend them in the shader",
                    name.unwrap_or("?")
                ),
            ));
        }
    }
    Ok(())
}

/// Every constant is an `override` of the shader, and every `override` without a value has a constant.
fn check_constants(module: &naga::Module, pass: &PlannedPass) -> Result<(), GraphError> {
    // An override with an `@id` is known by that number.
    let overrides = module.overrides.iter().filter_map(|(_, constant)| {
        let id = constant.id.map(|id| id.to_string());
        Some((id.or(constant.name.clone())?, constant.init.is_some()))
    });
    let overrides: BTreeMap<String, bool> = overrides.collect();
    let (given, mut names) = (&pass.constants, pass.constants.keys());
    if let Some(name) = names.find(|name| !overrides.contains_key(*name)) {
        return Err(mismatch(format!(
            "the node gives the constant '{name}', which is no override of the shader"
        )));
    }
    let mut open = overrides.iter().filter(|(_, has_value)| !**has_value);
    match open.find(|(name, _)| !given.contains_key(*name)) {
        None => Ok(()),
        Some((name, _)) => Err(mismatch(format!(
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
    let size = || actual.size(module.to_ctx());
    let image = |arrayed: bool, class: ImageClass| TypeInner::Image {
        dim: ImageDimension::D2,
        arrayed,
        class,
    };
    let (matches, expected) = match planned.layout {
        BindingLayout::Buffer {
            ty: BufferKind::Uniform,
            min_binding_size: bytes,
            ..
        } => {
            let what = match planned.resource {
                PlannedBindingResource::Regions { .. } => "array of regions",
                PlannedBindingResource::Parameters { .. }
                | PlannedBindingResource::Texture { .. }
                | PlannedBindingResource::StorageTexture { .. }
                | PlannedBindingResource::Buffer { .. }
                | PlannedBindingResource::Sampler(_) => "struct",
            };
            (
                space == AddressSpace::Uniform && size() == bytes,
                format!("a uniform {what} of {bytes} bytes"),
            )
        }
        BindingLayout::Buffer { ty, .. } => {
            let writable = ty == BufferKind::Storage;
            let touched = planned.touch();
            let bytes = touched.map_or(0, |it| resources[it.resource].desc.bytes());
            let stores = matches!(space, AddressSpace::Storage { access }
                if access.contains(naga::StorageAccess::STORE) == writable);
            let access = if writable { "writable" } else { "read-only" };
            (
                stores && u64::from(size()) <= bytes,
                format!("a {access} storage buffer of at most {bytes} bytes"),
            )
        }
        BindingLayout::Sampler { ty } => {
            let comparison = ty == SamplerKind::Comparison;
            let what = if comparison {
                "a comparison sampler"
            } else {
                "a sampler"
            };
            (
                *actual == TypeInner::Sampler { comparison },
                what.to_owned(),
            )
        }
        BindingLayout::StorageTexture { format, .. } => {
            let name = format.name();
            let stored = if let TypeInner::Image {
                class: ImageClass::Storage { format, .. },
                ..
            } = *actual
            {
                let access = naga::StorageAccess::STORE;
                format!("{format:?}").to_lowercase() == name
                    && *actual == image(false, ImageClass::Storage { format, access })
            } else {
                false
            };
            (
                stored,
                format!("a two-dimensional storage texture of format {name}, written only"),
            )
        }
        BindingLayout::Texture {
            sample_type,
            view_dimension,
            multisampled: multi,
        } => {
            let sampled = |kind| ImageClass::Sampled { kind, multi };
            let (class, kind) = match sample_type {
                SampleType::Depth => (ImageClass::Depth { multi }, "depth"),
                SampleType::Uint => (sampled(ScalarKind::Uint), "u32"),
                SampleType::Float | SampleType::UnfilterableFloat => {
                    (sampled(ScalarKind::Float), "float")
                }
            };
            let arrayed = view_dimension == ViewDimension::D2Array;
            let shape = match (arrayed, multi) {
                (_, true) => "multisampled two-dimensional",
                (false, false) => "two-dimensional",
                (true, false) => "two-dimensional array",
            };
            (
                *actual == image(arrayed, class),
                format!("a {shape} {kind} texture"),
            )
        }
    };
    (!matches).then_some(expected)
}
