//! Validation: whether a shader that imports modules of the library can be used everywhere that a profile promises.

mod alias;
mod atomics;
mod attributes;
mod backend;
mod bitcast;
mod bypass;
mod compiler;
mod constants;
mod diagnostic;
mod exercise;
mod features;
mod flow;
mod glsl;
mod lets;
mod limits;
mod message;
mod numbers;
mod operators;
mod overrides;
mod parameters;
mod pointer;
mod repair;
mod report;
mod selectors;
mod stage;
mod statements;
mod stopped;
mod storage_format;
mod uniformity;
mod words;

pub use backend::Backend;
pub use features::{Features, UnknownFeature};
pub use report::ValidationReport;

use crate::{Linked, Profile, Rule, ShaderError, Source, link};

/// What a shader is validated against.
#[derive(Clone, Copy, Debug, Default)]
pub struct ValidationOptions<'a> {
    /// What the shader may rely on.
    pub profile: Profile,
    /// Optional features that it may use as well.
    pub features: Features,
    /// Modules that it may import beside those of the library, as [`link()`] takes them.
    pub modules: &'a [Source<'a>],
}

/// Links `source` as [`link()`] does, validates it, and writes it for every [`Backend`].
///
/// A text without entry points is validated too: every function is called from an entry point made for it, with a zero for
/// each value and a bound resource for each texture and sampler. Overrides without a default get one of a few values with which the
/// shader is valid.
///
/// The profile decides what the shader may contain. What is valid under `webgpu-core`, browsers take: no optional feature of
/// WebGPU but those that are allowed; only the storage texture formats and accesses that every device has; no more of
/// buffers, textures, varyings and workgroup memory than WebGPU's default limits allow an entry point; uniform control flow where
/// derivatives, barriers and the like need it; no two names of one memory of which one is written; operators only in an order that
/// WGSL has; constant expressions only with values. `native` and `native-adapter` have what wgpu checks:
/// `native` the 16-bit normalised formats as well, `native-adapter` every format that naga knows.
///
/// All faults are reported that can be found at once: a function in which the compiler finds one is taken out, and the rest is
/// validated without it.
///
/// The WGSL compiler runs on a separate thread with a large stack, on texts of at most
/// [`LONGEST_SHADER`](ValidationReport::LONGEST_SHADER) bytes.
///
/// # A test for your shaders
/// ```no_run
/// use moment_shadows::{Source, ValidationOptions, validate};
///
/// // In a project's own tests/shaders.rs, as a #[test].
/// fn shaders_are_valid() -> std::io::Result<()> {
///     for entry in std::fs::read_dir("shaders")? {
///         let path = entry?.path();
///         let (name, text) = (path.display().to_string(), std::fs::read_to_string(&path)?);
///         let source = Source { name: &name, text: &text };
///         let report = validate(source, &ValidationOptions::default());
///         assert!(report.is_valid(), "{report}");
///     }
///     Ok(())
/// }
/// ```
#[must_use]
pub fn validate(source: Source<'_>, options: &ValidationOptions<'_>) -> ValidationReport {
    let refused = |error| ValidationReport {
        errors: vec![error],
        ..ValidationReport::default()
    };
    for source in core::iter::once(&source).chain(options.modules) {
        if let Err(error) = refuse_too_long(source.name, source.text) {
            return refused(error);
        }
    }
    let linked = link(source, options.modules)
        .and_then(|linked| refuse_too_long(source.name, linked.wgsl()).map(|()| linked));
    let linked = match linked {
        Ok(linked) => linked,
        Err(error) => return refused(error),
    };
    let mut report = on_large_stack(|| compile(linked.clone(), options))
        .unwrap_or_else(|| refused(stopped(&linked, options)));
    for error in report.errors.iter_mut().chain(&mut report.warnings) {
        error.in_file(source.name);
    }
    report
}

/// Where an error lies that the compiler gives no place for: in the statement without which it is another one, or none.
fn place_of(
    compiler: &compiler::Compiler<'_>,
    error: &ShaderError,
) -> Option<core::ops::Range<usize>> {
    let same = |text: &str| {
        let linked = &compiler.linked.with_text(text.to_owned());
        let compiled = compiler::Compiler {
            linked,
            ..*compiler
        }
        .compile();
        compiled.is_err_and(|fault| fault.error.message == error.message)
    };
    stopped::find(compiler.linked.wgsl(), same)
}

/// What is said where the compiler stops without a result.
fn stopped(linked: &Linked, options: &ValidationOptions<'_>) -> ShaderError {
    let stops = |text: &str| {
        let linked = linked.with_text(text.to_owned());
        on_large_stack(|| compile(linked, options)).is_none()
    };
    let place = stopped::find(linked.wgsl(), stops);
    let message = "naga, the compiler of wgpu and Firefox, stops here without a result; write it in another way, and report it to \
                   naga";
    ShaderError {
        places: place
            .and_then(|place| linked.location(place))
            .into_iter()
            .collect(),
        ..ShaderError::new(Rule::Unsupported, message)
    }
}

fn refuse_too_long(file: &str, text: &str) -> Result<(), ShaderError> {
    const LONGEST: usize = ValidationReport::LONGEST_SHADER;
    let bytes = text.len();
    if bytes <= LONGEST {
        return Ok(());
    }
    let message =
        format!("the shader has {bytes} bytes, and at most {LONGEST} are validated; split it");
    let mut error = ShaderError::new(Rule::Length, message);
    error.in_file(file);
    Err(error)
}

/// A byte of a text takes less than 1 KiB in an optimised build: the compiler recurses over long chains, the worst is one of `!`.
/// What is not touched takes addresses and no memory.
const STACK_BYTES: usize = ValidationReport::LONGEST_SHADER << 10;

/// The name of the thread that the WGSL compiler runs on. Where naga panics the shader is refused all the same; a program that has a panic
/// hook can leave out what is printed of it.
pub const COMPILER_THREAD: &str = "WGSL compiler";

/// Runs `work` on a thread with a large stack. `None` if the thread cannot be started, or `work` panics.
fn on_large_stack<T: Send>(work: impl FnOnce() -> T + Send) -> Option<T> {
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new()
            .name(COMPILER_THREAD.to_owned())
            .stack_size(STACK_BYTES);
        thread.spawn_scoped(scope, work).ok()?.join().ok()
    })
}

fn compile(mut linked: Linked, options: &ValidationOptions<'_>) -> ValidationReport {
    let mut report = ValidationReport::default();
    let is_core = options.profile.is_of_browsers();
    if is_core {
        report.errors.extend(operators::check(&linked));
        report.errors.extend(attributes::check(&linked));
        report.errors.extend(bypass::check(&linked));
        report.errors.extend(selectors::check(&linked));
    }
    let capabilities = options.features.capabilities();
    let compiled = loop {
        let compiler = compiler::Compiler {
            linked: &linked,
            capabilities,
        };
        match compiler.compile() {
            Ok(compiled) => break compiled,
            Err(mut fault) => {
                if fault.place.is_none() && fault.error.places.is_empty() {
                    fault.place = place_of(&compiler, &fault.error);
                    let place = fault.place.clone();
                    let place = place.and_then(|place| linked.location(place));
                    fault.error.places.extend(place);
                }
                report.errors.push(fault.error);
                let rest = fault
                    .place
                    .and_then(|place| repair::without_function(linked.wgsl(), &place));
                match rest {
                    Some(rest) if report.errors.len() < ValidationReport::MOST_ERRORS => {
                        linked = linked.with_text(rest);
                    }
                    _ => {
                        report.sort();
                        return report;
                    }
                }
            }
        }
    };
    let linked = &linked;
    let (module, info) = (&compiled.module, &compiled.info);
    report
        .errors
        .extend(storage_format::check(module, linked, options.profile));
    report.errors.extend(parameters::check(module, linked));
    if is_core {
        report.errors.extend(alias::check(module, linked));
        report.errors.extend(atomics::check(module, info, linked));
        report.errors.extend(constants::check(module, info, linked));
        report.errors.extend(numbers::check(module, linked));
        match overrides::given(&compiled, linked) {
            Ok((given, info)) => {
                report.errors.extend(limits::check(&given, &info, linked));
                // With defaults alone, what is constant now is so for a host that gives no values.
                if module.overrides.iter().all(|(_, of)| of.init.is_some()) {
                    report
                        .errors
                        .extend(constants::check(&given, &info, linked));
                }
            }
            Err(error) => report.errors.push(error),
        }
        report.errors.extend(flow::check(module, linked));
        uniformity::check(module, linked, &mut report);
    }
    if report.is_valid() {
        let shader = if module.entry_points.is_empty() {
            exercise::exercise(linked.wgsl(), compiled, capabilities)
        } else {
            backend::Shader {
                compiled,
                no_entry_point: None,
            }
        };
        match backend::write_all(&shader, linked) {
            Ok(outcomes) => report.outcomes = outcomes,
            Err(error) => report.errors.push(error),
        }
    }
    report.sort();
    report
}
