//! The result as JSON, version 1, as docs/ci.md describes it.

use moment_shadows::{Location, ShaderError};
use serde_json::{Value, json};

use super::{Checked, Outcome};

/// The version of the form. A field that goes, or changes its meaning, makes a new one; a new field does not.
const VERSION: u32 = 1;

pub(super) fn of(outcome: &Outcome, quiet: bool) -> Value {
    let files = outcome.files.iter();
    let files = files.filter(|it| {
        let is_clean = it.report.is_valid() && it.report.warnings.is_empty();
        !(quiet && is_clean)
    });
    json!({
        "version": VERSION,
        "profile": outcome.profile.name(),
        "files": files.map(file).collect::<Vec<_>>(),
    })
}

fn file(checked: &Checked) -> Value {
    let backends = checked
        .report
        .outcomes
        .iter()
        .map(|(backend, outcome)| match outcome {
            Ok(()) => json!({ "name": backend.name(), "written": true }),
            Err(reason) => json!({ "name": backend.name(), "written": false, "reason": reason }),
        });
    let errors = checked.report.errors.iter().map(|it| finding("error", it));
    let warnings = checked
        .report
        .warnings
        .iter()
        .map(|it| finding("warning", it));
    json!({
        "file": checked.name,
        "valid": checked.report.is_valid(),
        "backends": backends.collect::<Vec<_>>(),
        "findings": errors.chain(warnings).collect::<Vec<_>>(),
    })
}

fn finding(severity: &str, error: &ShaderError) -> Value {
    json!({
        "severity": severity,
        "rule": error.rule.name(),
        "message": error.message,
        "places": error.places.iter().map(place).collect::<Vec<_>>(),
        "notes": error.notes,
    })
}

fn place(at: &Location) -> Value {
    json!({
        "file": at.file,
        "line": at.line,
        "column": at.column,
        "width": at.width,
        "text": at.text,
        "label": at.label,
    })
}
