//! GLSL as wgpu hands it to a driver of OpenGL, for the shaders that validation calls good there.

use moment_shadows::{Backend, Source, ValidationOptions, validate};
use naga::ShaderStage;
use naga::back::glsl;
use naga::proc::BoundsCheckPolicies;

use super::Shader;
use super::spirv::Compiled;
use crate::error::LabError;

/// Versions of GLSL, with the name that files have for them.
const VERSIONS: [(Backend, &str, glsl::Version); 2] = [
    (Backend::Glsl450, "450", glsl::Version::Desktop(450)),
    (
        Backend::GlslEs300,
        "300es",
        glsl::Version::Embedded {
            version: 300,
            is_webgl: true,
        },
    ),
];

/// The versions that `shader` can be written for, by the library's own word.
pub(super) fn versions(shader: &Shader) -> Vec<(&'static str, glsl::Version)> {
    let options = ValidationOptions {
        profile: shader.profile,
        ..ValidationOptions::default()
    };
    let (name, text) = (shader.name.as_str(), shader.wgsl.as_str());
    let report = validate(Source { name, text }, &options);
    let written: Vec<Backend> = report.written().collect();
    let versions = VERSIONS.into_iter();
    versions
        .filter(|(backend, ..)| written.contains(backend))
        .map(|(_, name, version)| (name, version))
        .collect()
}

/// How glslang knows the stage of a file.
pub(super) fn extension(stage: ShaderStage) -> &'static str {
    match stage {
        ShaderStage::Vertex => "vert",
        ShaderStage::Fragment => "frag",
        _ => "comp",
    }
}

impl Compiled<'_> {
    /// The GLSL of an entry point.
    pub(super) fn glsl(
        &self,
        entry_point: &naga::EntryPoint,
        version: glsl::Version,
    ) -> Result<String, LabError> {
        let failed = |reason: String| self.failed(entry_point, reason);
        let (module, info) = self
            .of_entry_point(entry_point)
            .map_err(|error| failed(error.to_string()))?;
        let options = glsl::Options {
            version,
            ..glsl::Options::default()
        };
        let pipeline = glsl::PipelineOptions {
            shader_stage: entry_point.stage,
            entry_point: entry_point.name.clone(),
            multiview: None,
        };
        let mut text = String::new();
        let policies = BoundsCheckPolicies::default();
        glsl::Writer::new(&mut text, &module, &info, &options, &pipeline, policies)
            .and_then(|mut writer| writer.write())
            .map_err(|error| failed(error.to_string()))?;
        Ok(text)
    }
}
