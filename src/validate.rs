//! Validation: whether a shader that imports modules of the library can be used everywhere that a profile promises.

mod backend;
mod diagnostic;
mod exercise;
mod limits;
mod operators;
mod storage_format;

use naga::front::wgsl::ParseError;
use naga::valid::{Capabilities, ModuleInfo, ValidationFlags, Validator};

pub use backend::Backend;

use crate::{Linked, Profile, ShaderError, Source, link};

/// What each backend makes of a valid shader.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ValidationReport {
    /// Whether each of [`Backend::ALL`], in that order, can express the shader. What a language lacks is not an error, since no
    /// profile includes the two GLSL versions; the reason names the entry point.
    pub outcomes: Vec<(Backend, Result<(), String>)>,
}

impl ValidationReport {
    /// The longest text that is validated, in bytes, before and after linking.
    pub const LONGEST_SHADER: usize = 1 << 19;

    /// The backends that the shader was written for.
    pub fn written(&self) -> impl Iterator<Item = Backend> {
        let written = self.outcomes.iter().filter(|(_, outcome)| outcome.is_ok());
        written.map(|(backend, _)| *backend)
    }
}

/// Links `source` as [`link()`] does, validates it under `profile`, and writes it for every [`Backend`].
///
/// A text without entry points is validated too: every function is called from an entry point made for it, with a zero for
/// each value and a bound resource for each texture and sampler. Overrides without a default get one of a few values with which the
/// shader is valid.
///
/// The profile decides what the shader may contain: `webgpu-core` no optional feature of WebGPU, and only the storage
/// texture formats and accesses that every device has, and no more of buffers, textures, varyings and workgroup memory than WebGPU's default
/// limits allow an entry point; `native` the 16-bit normalised ones as well; `native-adapter` every
/// format that naga knows.
///
/// The WGSL compiler runs on a separate thread with a large stack, on texts of at most
/// [`LONGEST_SHADER`](ValidationReport::LONGEST_SHADER) bytes.
///
/// # Errors
/// [`ShaderError`], which points at the line of the file before linking.
pub fn validate(
    source: Source<'_>,
    generated: &[Source<'_>],
    profile: Profile,
) -> Result<ValidationReport, ShaderError> {
    for source in core::iter::once(&source).chain(generated) {
        refuse_too_long(source.name, source.text)?;
    }
    let linked = link(source, generated)?;
    refuse_too_long(source.name, linked.wgsl())?;
    on_large_stack(|| compile(&linked, profile))
        .unwrap_or_else(|| {
            let message = "the WGSL compiler stopped without a result; cut the shader down to what makes it stop, and report it \
                           to naga";
            Err(ShaderError::new(message))
        })
        .map_err(|error| error.in_file(source.name))
}

fn refuse_too_long(file: &str, text: &str) -> Result<(), ShaderError> {
    const LONGEST: usize = ValidationReport::LONGEST_SHADER;
    let bytes = text.len();
    if bytes <= LONGEST {
        return Ok(());
    }
    let message =
        format!("the shader has {bytes} bytes, and at most {LONGEST} are validated; split it");
    Err(ShaderError::new(message).in_file(file))
}

/// A byte of a text takes less than 1 KiB in an optimised build: the compiler recurses over long chains, the worst is one of `!`.
/// What is not touched takes addresses and no memory.
const STACK_BYTES: usize = ValidationReport::LONGEST_SHADER << 10;

/// Runs `work` on a thread with a large stack. `None` if the thread cannot be started, or `work` panics.
fn on_large_stack<T: Send>(work: impl FnOnce() -> T + Send) -> Option<T> {
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK_BYTES);
        thread.spawn_scoped(scope, work).ok()?.join().ok()
    })
}

fn compile(linked: &Linked, profile: Profile) -> Result<ValidationReport, ShaderError> {
    let capabilities = capabilities(profile);
    let module = parse(linked.wgsl(), capabilities)
        .map_err(|error| diagnostic::of_parse_error(linked, &error))?;
    storage_format::check(&module, linked, profile)?;
    let info = check(&module, capabilities)
        .map_err(|error| diagnostic::of_validation_error(linked, &module, &error))?;
    if profile == Profile::WebgpuCore {
        operators::check(linked)?;
        limits::check(&module, &info, linked)?;
    }
    let shader = if module.entry_points.is_empty() {
        exercise::exercise(linked.wgsl(), module, info, capabilities)
    } else {
        backend::Shader {
            module,
            info,
            no_entry_point: None,
        }
    };
    backend::write_all(&shader)
}

fn parse(text: &str, capabilities: Capabilities) -> Result<naga::Module, Box<ParseError>> {
    let mut options = naga::front::wgsl::Options::new();
    options.capabilities = capabilities;
    let mut frontend = naga::front::wgsl::Frontend::new_with_options(options);
    frontend.parse(text).map_err(Box::new)
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
