//! The result for people.

use moment_shadows::{ShaderError, ValidationReport};

use super::Outcome;
use crate::command::{CommandError, output};

/// Prints, in the order of files, a line for each valid one with the backends it can be written for, and all findings.
pub(super) fn print(outcome: &Outcome, quiet: bool) -> Result<(), CommandError> {
    for file in &outcome.files {
        if file.report.is_valid() && !quiet {
            output::print(format_args!(
                "ok  {}  {}",
                file.name,
                backends(&file.report)
            ))?;
        }
        let said = |severity: &str, error: &ShaderError| {
            output::print(format_args!("{severity}[{}]: {error}\n", error.rule))
        };
        for error in &file.report.errors {
            said("error", error)?;
        }
        for warning in &file.report.warnings {
            said("warning", warning)?;
        }
    }
    let (invalid, all) = (outcome.invalid(), outcome.files.len());
    if invalid > 0 && !quiet {
        let profile = outcome.profile;
        output::say(format_args!(
            "{invalid} of {all} files are not valid under profile `{profile}`"
        ));
    }
    Ok(())
}

/// The backends that were written, then the others with their reasons.
fn backends(report: &ValidationReport) -> String {
    let written: Vec<_> = report.written().map(|backend| backend.name()).collect();
    let mut line = written.join(" ");
    for (backend, outcome) in &report.outcomes {
        if let Err(reason) = outcome {
            line += &format!("; not {backend}: {reason}");
        }
    }
    line
}
