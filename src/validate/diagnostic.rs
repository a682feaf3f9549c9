//! What the WGSL compiler says about a shader, at the places before linking.

use core::fmt;
use core::ops::Range;
use std::error::Error;

use naga::front::wgsl::ParseError;
use naga::valid::ValidationError;

use crate::{Linked, Location};

/// A message about a shader, with the places that it is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The file that was validated.
    pub file: String,
    /// What is wrong.
    pub message: String,
    /// The places, the most telling one first. Empty where the compiler names none.
    pub labels: Vec<Label>,
    /// Further sentences: causes, and next steps.
    pub notes: Vec<String>,
}

/// A place that a [`Diagnostic`] is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place, in a file before linking.
    pub at: Location,
    /// What is there; may be empty.
    pub text: String,
}

impl Diagnostic {
    pub(super) fn of_parse_error(file: &str, linked: &Linked, error: &ParseError) -> Self {
        let labels = error
            .labels()
            .filter_map(|(span, text)| Label::new(linked, span.to_range()?, text))
            .collect();
        Self {
            file: file.to_owned(),
            message: error.message().to_owned(),
            labels,
            notes: error.notes().map(str::to_owned).collect(),
        }
    }

    pub(super) fn of_validation_error(
        file: &str,
        linked: &Linked,
        error: &naga::WithSpan<ValidationError>,
    ) -> Self {
        let labels = error
            .spans()
            .filter_map(|(span, text)| {
                // Names of naga's types and handles say nothing to the author of a shader.
                let text = if text.starts_with("naga::") { "" } else { text };
                Label::new(linked, span.to_range()?, text)
            })
            .collect();
        let mut notes = Vec::new();
        let mut cause = error.as_inner().source();
        while let Some(error) = cause {
            notes.push(error.to_string());
            cause = error.source();
        }
        Self {
            file: file.to_owned(),
            message: error.as_inner().to_string(),
            labels,
            notes,
        }
    }
}

impl Label {
    /// The bytes `range` of the linked text. None for text that is in no file.
    pub(super) fn new(linked: &Linked, range: Range<usize>, text: &str) -> Option<Self> {
        Some(Self {
            at: linked.location(range)?,
            text: text.to_owned(),
        })
    }
}

impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.message)?;
        if self.labels.is_empty() {
            write!(f, "\n --> {}", self.file)?;
        }
        for label in &self.labels {
            writeln!(f)?;
            label.at.write(f, &label.text)?;
        }
        for note in &self.notes {
            write!(f, "\n = {note}")?;
        }
        Ok(())
    }
}
