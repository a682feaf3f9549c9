//! `moment-shadows validate`: checks shader files under a profile, as one would in continuous integration.

use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use moment_shadows::{Profile, ShaderError, Source, ValidationReport, validate};

use super::{CommandResult, argument};

/// What `validate` takes.
#[derive(clap::Args)]
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
    pub fn run(self) -> CommandResult {
        Ok(run(&self.files, self.profile))
    }
}

/// A file that could not be read, or is not valid.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckError {
    /// The file cannot be read.
    #[error("cannot read `{path}`: {source}; name a file with WGSL text")]
    Read {
        /// The file.
        path: String,
        /// What the system says.
        source: io::Error,
    },
    /// The shader is not valid.
    #[error(transparent)]
    Invalid(#[from] ShaderError),
}

/// Validates each of `files` under `profile` (`webgpu-core` without one). Prints a line for each valid file with the
/// backends it can be written for, and then all errors together. Fails if any file does.
pub fn run(files: &[PathBuf], profile: Option<Profile>) -> ExitCode {
    let profile = profile.unwrap_or_default();
    let mut errors = Vec::new();
    for path in files {
        match check_file(path, profile) {
            Ok(report) => println!("ok  {}  {}", path.display(), summary(&report)),
            Err(error) => errors.push(error),
        }
    }
    for error in &errors {
        eprintln!("error: {error}\n");
    }
    if errors.is_empty() {
        return ExitCode::SUCCESS;
    }
    let (failed, all) = (errors.len(), files.len());
    eprintln!("{failed} of {all} files are not valid under profile `{profile}`");
    ExitCode::FAILURE
}

/// Validates a file: as a module of the library if its imports start with `super::`, else as a user's shader.
///
/// # Errors
/// [`CheckError`] if it cannot be read or is not valid.
pub fn check_file(path: &Path, profile: Profile) -> Result<ValidationReport, CheckError> {
    let name = path.display().to_string();
    let text = read(path).map_err(|source| CheckError::Read {
        path: name.clone(),
        source,
    })?;
    let source = Source {
        name: &name,
        text: &text,
    };
    Ok(validate(source, &[], profile)?)
}

/// Reads no more than is needed to see that a file is too long.
fn read(path: &Path) -> io::Result<String> {
    const LONGEST: usize = ValidationReport::LONGEST_SHADER;
    let mut bytes = Vec::new();
    File::open(path)?
        .take(LONGEST as u64 + 1)
        .read_to_end(&mut bytes)?;
    if bytes.len() > LONGEST {
        let message = format!("it is longer than {LONGEST} bytes");
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, message));
    }
    String::from_utf8(bytes)
        .map_err(|_| io::Error::new(io::ErrorKind::InvalidData, "it is not UTF-8 text"))
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
