//! Validation: whether a shader that imports modules of the library can be used everywhere that a profile promises.

mod backend;
mod constants;
mod diagnostic;
mod error;
mod exercise;
mod limits;
mod storage_format;
mod values;

use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

pub use backend::{Backend, Outcome};
pub use constants::{LARGEST_CONSTANT, MOST_CONSTANTS};
pub use diagnostic::{Diagnostic, Label};
pub use error::ValidateError;
pub use limits::{LONGEST_CHAIN, LONGEST_DEFINITION, LONGEST_SHADER};
pub use values::{LARGEST_VALUE, MOST_EXPRESSIONS, MOST_VALUES};

use crate::{Linked, Profile, Source, link, link_module};

/// What each backend makes of a valid shader.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ValidationReport {
    /// One outcome for each of [`Backend::ALL`], in that order.
    pub outcomes: Vec<(Backend, Outcome)>,
}

impl ValidationReport {
    /// The backends that the shader was written for.
    pub fn written(&self) -> impl Iterator<Item = Backend> {
        let written = |(backend, outcome): &(Backend, Outcome)| {
            (*outcome == Outcome::Written).then_some(*backend)
        };
        self.outcomes.iter().filter_map(written)
    }

    /// What `backend` made of the shader.
    #[must_use]
    pub fn outcome(&self, backend: Backend) -> Option<&Outcome> {
        let found = self.outcomes.iter().find(|(of, _)| *of == backend);
        found.map(|(_, outcome)| outcome)
    }
}

/// Links `source` as [`link()`] does, validates it under `profile`, and writes it for every [`Backend`].
///
/// A text without entry points is validated too: every function is called from an entry point made for it, with a zero for
/// each value and a bound resource for each texture and sampler. Overrides without a default get the value 1.
///
/// The profile decides what the shader may contain: `webgpu-core` no optional feature of WebGPU, and only the storage
/// texture formats and accesses that every device has; `native` the 16-bit normalised ones as well; `native-adapter` every
/// format that naga knows.
///
/// The WGSL compiler runs on a separate thread with a large stack; [`LONGEST_SHADER`], [`LONGEST_DEFINITION`],
/// [`LONGEST_CHAIN`], [`LARGEST_CONSTANT`], [`MOST_CONSTANTS`], [`LARGEST_VALUE`], [`MOST_VALUES`] and [`MOST_EXPRESSIONS`]
/// bound what it is given, so that an answer takes seconds at most.
///
/// # Errors
/// [`ValidateError`], which points at the line of the file before linking.
pub fn validate(
    source: Source<'_>,
    generated: &[Source<'_>],
    profile: Profile,
) -> Result<ValidationReport, ValidateError> {
    for source in core::iter::once(&source).chain(generated) {
        limits::refuse_too_long(source.name, source.text)?;
    }
    validate_linked(source.name, &link(source, generated)?, profile)
}

/// Validates a file that is written as a module of the library ([`link_module()`]), otherwise as [`validate()`].
///
/// # Errors
/// [`ValidateError`], which points at the line of the file before linking.
pub fn validate_module(
    source: Source<'_>,
    profile: Profile,
) -> Result<ValidationReport, ValidateError> {
    limits::refuse_too_long(source.name, source.text)?;
    validate_linked(source.name, &link_module(source)?, profile)
}

fn validate_linked(
    file: &str,
    linked: &Linked,
    profile: Profile,
) -> Result<ValidationReport, ValidateError> {
    limits::refuse_too_long(file, linked.wgsl())?;
    limits::refuse_long_chains(linked)?;
    limits::on_large_stack(|| compile(file, linked, profile)).unwrap_or_else(|| {
        Err(ValidateError::Compiler {
            file: file.to_owned(),
        })
    })
}

fn compile(
    file: &str,
    linked: &Linked,
    profile: Profile,
) -> Result<ValidationReport, ValidateError> {
    let capabilities = capabilities(profile);
    let mut options = naga::front::wgsl::Options::new();
    options.capabilities = capabilities;
    let module = naga::front::wgsl::Frontend::new_with_options(options)
        .parse(linked.wgsl())
        .map_err(|error| ValidateError::Parse(Diagnostic::of_parse_error(file, linked, &error)))?;
    storage_format::check(file, &module, linked, profile)?;
    let info = check(&module, capabilities).map_err(|error| {
        ValidateError::Invalid(Diagnostic::of_validation_error(
            file, linked, &module, &error,
        ))
    })?;
    values::refuse_large(linked, &module, &info)?;
    let shader = if module.entry_points.is_empty() {
        exercise::exercise(&module, info, capabilities)
    } else {
        backend::Shader::new(module, info)
    };
    backend::write_all(file, &shader)
}

fn check(
    module: &naga::Module,
    capabilities: Capabilities,
) -> Result<ModuleInfo, Box<naga::WithSpan<naga::valid::ValidationError>>> {
    Validator::new(ValidationFlags::all(), capabilities)
        .validate(module)
        .map_err(Box::new)
}

/// What naga may accept under `profile`. The three of the core are not optional features: sample shading, cube array
/// textures, and packing of 16-bit floats.
fn capabilities(profile: Profile) -> Capabilities {
    let core = Capabilities::MULTISAMPLED_SHADING
        | Capabilities::CUBE_ARRAY_TEXTURES
        | Capabilities::SHADER_FLOAT16_IN_FLOAT32;
    match profile {
        Profile::WebgpuCore => core,
        Profile::Native | Profile::NativeAdapter => {
            core | Capabilities::STORAGE_TEXTURE_16BIT_NORM_FORMATS
        }
    }
}
