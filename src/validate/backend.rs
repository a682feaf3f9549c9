//! The shading languages that wgpu feeds to drivers.

use core::fmt;

use naga::Module;
use naga::back::pipeline_constants::process_overrides;
use naga::back::{PipelineConstants, glsl, hlsl, msl, spv};
use naga::proc::BoundsCheckPolicies;
use naga::valid::ModuleInfo;

use super::compiler::Compiled;
use super::overrides;
use crate::{Linked, Rule, ShaderError};

/// A language that a shader is translated to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Backend {
    /// SPIR-V 1.0, for Vulkan.
    SpirV,
    /// HLSL for shader model 6.0, for Direct3D 12.
    Hlsl,
    /// Metal shading language 2.1.
    Msl,
    /// GLSL 4.50, for desktop OpenGL.
    Glsl450,
    /// GLSL ES 3.00, for WebGL 2.
    GlslEs300,
}

impl Backend {
    /// Every backend.
    pub const ALL: [Backend; 5] = [
        Backend::SpirV,
        Backend::Hlsl,
        Backend::Msl,
        Backend::Glsl450,
        Backend::GlslEs300,
    ];

    /// The name used on command lines.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Backend::SpirV => "spirv",
            Backend::Hlsl => "hlsl",
            Backend::Msl => "msl",
            Backend::Glsl450 => "glsl-450",
            Backend::GlslEs300 => "glsl-es-300",
        }
    }
}

impl fmt::Display for Backend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A valid module, ready to be written.
pub(super) struct Shader {
    pub(super) compiled: Compiled,
    /// Why no entry point could be made, for a module without any.
    pub(super) no_entry_point: Option<String>,
}

/// Whether each backend can express a shader, or why not.
pub(super) type Outcomes = Vec<(Backend, Result<(), String>)>;

/// What each of [`Backend::ALL`] makes of `shader`. SPIR-V, HLSL and MSL can express whatever a profile allows, so there a failure is an
/// error; but for external textures, which browsers take without them.
pub(super) fn write_all(shader: &Shader, linked: &Linked) -> Result<Outcomes, ShaderError> {
    // Backends want constants in place of overrides.
    let (module, info) = overrides::given(&shader.compiled, linked)?;
    let is_external = has_external_textures(&module);
    let outcome = |backend| {
        if is_external && !matches!(backend, Backend::Hlsl | Backend::Msl) {
            let reason = "naga cannot write external textures for it yet".to_owned();
            return Ok((backend, Err(reason)));
        }
        let written = match backend {
            Backend::SpirV => write_spirv(&module, &info),
            Backend::Hlsl => write_hlsl(&module, &info),
            Backend::Msl => write_msl(&module, &info),
            Backend::Glsl450 | Backend::GlslEs300 => {
                let no_entry_point = shader.no_entry_point.clone().map_or(Ok(()), Err);
                let written = no_entry_point.and_then(|()| write_glsl(backend, &module, &info));
                return Ok((backend, written));
            }
        };
        match written {
            Err(message) => {
                let message = format!("{backend} cannot be written: {message}");
                Err(ShaderError::new(Rule::Backend, message))
            }
            Ok(()) => Ok((backend, Ok(()))),
        }
    };
    Backend::ALL.into_iter().map(outcome).collect()
}

fn has_external_textures(module: &Module) -> bool {
    let is_external = |ty: &naga::Type| {
        let class = match &ty.inner {
            naga::TypeInner::Image { class, .. } => class,
            _ => return false,
        };
        matches!(class, naga::ImageClass::External)
    };
    module.types.iter().any(|(_, ty)| is_external(ty))
}

fn write_spirv(module: &Module, info: &ModuleInfo) -> Result<(), String> {
    let written = spv::write_vec(module, info, &spv::Options::default(), None);
    written.map(drop).map_err(|error| error.to_string())
}

fn write_hlsl(module: &Module, info: &ModuleInfo) -> Result<(), String> {
    let options = hlsl::Options {
        shader_model: hlsl::ShaderModel::V6_0,
        ..Default::default()
    };
    let pipeline = hlsl::PipelineOptions::default();
    let mut text = String::new();
    let written = hlsl::Writer::new(&mut text, &options, &pipeline).write(module, info, None);
    let names = written.map_err(|error| error.to_string())?;
    all_named(names.entry_point_names)
}

/// The first error among the names of entry points.
fn all_named<E: fmt::Display>(names: Vec<Result<String, E>>) -> Result<(), String> {
    let error = names.into_iter().find_map(Result::err);
    error.map_or(Ok(()), |error| Err(error.to_string()))
}

fn write_msl(module: &Module, info: &ModuleInfo) -> Result<(), String> {
    let options = msl::Options {
        lang_version: (2, 1),
        ..Default::default()
    };
    let pipeline = msl::PipelineOptions::default();
    let written = msl::write_string(module, info, &options, &pipeline);
    let (_, translation) = written.map_err(|error| error.to_string())?;
    all_named(translation.entry_point_names)
}

/// GLSL has one entry point per text.
fn write_glsl(backend: Backend, module: &Module, info: &ModuleInfo) -> Result<(), String> {
    let options = glsl::Options {
        version: if backend == Backend::GlslEs300 {
            // As WebGL has it.
            glsl::Version::Embedded {
                version: 300,
                is_webgl: true,
            }
        } else {
            glsl::Version::Desktop(450)
        },
        ..Default::default()
    };
    for entry_point in &module.entry_points {
        let name = &entry_point.name;
        let failed = |error: &dyn fmt::Display| format!("entry point `{name}`: {error}");
        // wgpu writes a module of one entry point, without what that does not use.
        let chosen = Some((entry_point.stage, name.as_str()));
        let (module, info) = process_overrides(module, info, chosen, &PipelineConstants::default())
            .map_err(|error| failed(&error))?;
        let pipeline = glsl::PipelineOptions {
            shader_stage: entry_point.stage,
            entry_point: name.clone(),
            multiview: None,
        };
        let mut text = String::new();
        let policies = BoundsCheckPolicies::default();
        glsl::Writer::new(&mut text, &module, &info, &options, &pipeline, policies)
            .and_then(|mut writer| writer.write())
            .map_err(|error| failed(&error))?;
        if let Some(objection) = super::glsl::objection(&module, entry_point, &info, backend) {
            return Err(failed(&objection));
        }
    }
    Ok(())
}
