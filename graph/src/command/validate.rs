//! `moment-shadows validate`: checks shader files under a profile, as one would in continuous integration.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use moment_shadows::{Profile, Source, ValidationReport, validate};

use super::{CommandError, argument, output, read};

/// What `validate` takes.
#[derive(Debug, clap::Args)]
pub struct Options {
    /// WGSL files.
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// What the shaders may rely on.
    #[arg(long, value_parser = argument::profile())]
    profile: Option<Profile>,
}

impl Options {
    /// Validates the files as [`run`] does.
    ///
    /// # Errors
    /// [`CommandError::Output`].
    pub fn run(self) -> Result<ExitCode, CommandError> {
        run(&self.files, self.profile)
    }
}

/// Validates each of `files` under `profile` (`webgpu-core` without one). Prints a line for each valid file with the
/// backends it can be written for, and then all errors together. Fails if any file does.
///
/// # Errors
/// [`CommandError::Output`].
pub fn run(files: &[PathBuf], profile: Option<Profile>) -> Result<ExitCode, CommandError> {
    let profile = profile.unwrap_or_default();
    let mut errors = Vec::new();
    for path in files {
        match check_file(path, profile) {
            Ok(report) => {
                output::print(format_args!("ok  {}  {}", path.display(), summary(&report)))?
            }
            Err(error) => errors.push(error),
        }
    }
    for error in &errors {
        output::say(format_args!("error: {error}\n"));
    }
    if errors.is_empty() {
        return Ok(ExitCode::SUCCESS);
    }
    let (failed, all) = (errors.len(), files.len());
    output::say(format_args!(
        "{failed} of {all} files are not valid under profile `{profile}`"
    ));
    Ok(ExitCode::FAILURE)
}

/// Validates a file: as a module of the library if its imports start with `super::`, else as a user's shader.
///
/// # Errors
/// [`CommandError::Read`] or [`CommandError::Shader`].
pub fn check_file(path: &Path, profile: Profile) -> Result<ValidationReport, CommandError> {
    let name = path.display().to_string();
    let text = read::read(path, ValidationReport::LONGEST_SHADER)?;
    let source = Source {
        name: &name,
        text: &text,
    };
    Ok(validate(source, &[], profile)?)
}

/// The backends that were written, then the others with their reasons.
fn summary(report: &ValidationReport) -> String {
    let written: Vec<_> = report.written().map(|backend| backend.name()).collect();
    let mut line = written.join(" ");
    for (backend, outcome) in &report.outcomes {
        if let Err(reason) = outcome {
            line += &format!("; not {backend}: {reason}");
        }
    }
    line
}
