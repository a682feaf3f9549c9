//! `moment-shadows-lab vectors`: the shader on vectors with known bounds.

use std::path::PathBuf;
use std::process::ExitCode;

use super::CommandResult;
use crate::vectors;

/// What `vectors` takes.
#[derive(clap::Args)]
pub struct Options {
    /// A file in the format of tests/vectors/moment_problem.json.
    file: PathBuf,
}

impl Options {
    /// Prints the report; fails where a bound is not within its tolerance.
    pub fn run(self) -> CommandResult {
        let report = vectors::run(&self.file)?;
        println!("{report}");
        Ok(match report.passed() {
            true => ExitCode::SUCCESS,
            false => ExitCode::FAILURE,
        })
    }
}
