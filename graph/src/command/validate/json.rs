//! The result as JSON, version 1, as docs/ci.md describes it.

use moment_shadows::{Location, Profile, ShaderError};
use serde::Serialize;

use super::{Checked, Outcome};

/// The version of the form. A field that goes, or changes its meaning, makes a new one; a new field does not.
const VERSION: u32 = 1;

#[derive(Serialize)]
pub(super) struct Json<'a> {
    version: u32,
    profile: Profile,
    files: Vec<File<'a>>,
}

#[derive(Serialize)]
struct File<'a> {
    file: &'a str,
    valid: bool,
    backends: Vec<Backend<'a>>,
    findings: Vec<Finding<'a>>,
}

#[derive(Serialize)]
struct Backend<'a> {
    name: &'static str,
    written: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'a str>,
}

#[derive(Serialize)]
struct Finding<'a> {
    severity: &'static str,
    rule: &'static str,
    message: &'a str,
    places: Vec<Place<'a>>,
    notes: &'a [String],
}

#[derive(Serialize)]
struct Place<'a> {
    file: &'a str,
    line: u32,
    column: u32,
    width: u32,
    text: &'a str,
    label: &'a str,
}

pub(super) fn of(outcome: &Outcome, quiet: bool) -> Json<'_> {
    let files = outcome.files.iter();
    let files = files.filter(|it| {
        let is_clean = it.report.is_valid() && it.report.warnings.is_empty();
        !(quiet && is_clean)
    });
    Json {
        version: VERSION,
        profile: outcome.profile,
        files: files.map(file).collect(),
    }
}

fn file(checked: &Checked) -> File<'_> {
    let backends = checked.report.outcomes.iter();
    let backends = backends.map(|(backend, outcome)| Backend {
        name: backend.name(),
        written: outcome.is_ok(),
        reason: outcome.as_ref().err().map(String::as_str),
    });
    let errors = checked.report.errors.iter().map(|it| finding("error", it));
    let warnings = checked
        .report
        .warnings
        .iter()
        .map(|it| finding("warning", it));
    File {
        file: &checked.name,
        valid: checked.report.is_valid(),
        backends: backends.collect(),
        findings: errors.chain(warnings).collect(),
    }
}

fn finding<'a>(severity: &'static str, error: &'a ShaderError) -> Finding<'a> {
    Finding {
        severity,
        rule: error.rule.name(),
        message: &error.message,
        places: error.places.iter().map(place).collect(),
        notes: &error.notes,
    }
}

fn place(at: &Location) -> Place<'_> {
    Place {
        file: &at.file,
        line: at.line,
        column: at.column,
        width: at.width,
        text: &at.text,
        label: &at.label,
    }
}
