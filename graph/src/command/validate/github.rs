//! The result as GitHub's workflows show it at the lines of a change (workflow commands `error` and `warning`).

use super::Outcome;
use crate::command::{CommandError, output};

/// Prints a line for each finding.
pub(super) fn print(outcome: &Outcome) -> Result<(), CommandError> {
    for (severity, file, error) in outcome.findings() {
        let place = match error.places.first() {
            Some(at) => format!(
                "file={},line={},col={},endColumn={}",
                property(&at.file),
                at.line,
                at.column,
                at.column.saturating_add(at.width)
            ),
            None => format!("file={}", property(&file.name)),
        };
        let mut message = error.message.clone();
        for note in &error.notes {
            message += &format!("\n{note}");
        }
        let title = format!("shader: {}", error.rule);
        output::print(format_args!(
            "::{severity} {place},title={}::{}",
            property(&title),
            escaped(&message)
        ))?;
    }
    Ok(())
}

/// A message without what would end it.
fn escaped(text: &str) -> String {
    text.replace('%', "%25")
        .replace('\r', "%0D")
        .replace('\n', "%0A")
}

/// A property without what would end it.
fn property(text: &str) -> String {
    escaped(text).replace(':', "%3A").replace(',', "%2C")
}
