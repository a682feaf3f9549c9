//! The result as SARIF 2.1.0 (OASIS, "Static Analysis Results Interchange Format").

use moment_shadows::{Location, Rule, ShaderError};
use serde_json::{Value, json};

use super::Outcome;

pub(super) fn of(outcome: &Outcome) -> Value {
    let rules = Rule::ALL.into_iter().map(|rule| {
        json!({
            "id": rule.name(),
            "shortDescription": { "text": rule.description() },
        })
    });
    let results = outcome.findings();
    let results = results.map(|(severity, file, error)| result(severity, &file.name, error));
    json!({
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": "moment-shadows",
                "version": env!("CARGO_PKG_VERSION"),
                "informationUri": env!("CARGO_PKG_REPOSITORY"),
                "rules": rules.collect::<Vec<_>>(),
            }},
            "columnKind": "unicodeCodePoints",
            "results": results.collect::<Vec<_>>(),
        }],
    })
}

fn result(severity: &str, file: &str, error: &ShaderError) -> Value {
    let mut message = error.message.clone();
    for note in &error.notes {
        message += &format!("\n{note}");
    }
    let (first, others) = match error.places.split_first() {
        Some((first, others)) => (location(first), others),
        None => (
            json!({ "physicalLocation": { "artifactLocation": artifact(file) } }),
            &[][..],
        ),
    };
    let related = others.iter().map(|at| {
        let mut related = location(at);
        if !at.label.is_empty() {
            related["message"] = json!({ "text": at.label });
        }
        related
    });
    json!({
        "ruleId": error.rule.name(),
        "level": severity,
        "message": { "text": message },
        "locations": [first],
        "relatedLocations": related.collect::<Vec<_>>(),
    })
}

fn location(at: &Location) -> Value {
    json!({
        "physicalLocation": {
            "artifactLocation": artifact(&at.file),
            "region": {
                "startLine": at.line,
                "startColumn": at.column,
                "endColumn": at.column.saturating_add(at.width),
                "snippet": { "text": at.text },
            },
        },
    })
}

/// A file as a URI reference (RFC 3986): slashes, and what is not allowed in a path as bytes.
fn artifact(file: &str) -> Value {
    let mut uri = String::new();
    for byte in file.replace('\\', "/").bytes() {
        if byte.is_ascii_alphanumeric() || b"-._~/!$&'()*+,;=@".contains(&byte) {
            uri.push(byte.into());
        } else {
            uri += &format!("%{byte:02X}");
        }
    }
    json!({ "uri": uri })
}
