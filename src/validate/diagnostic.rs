//! What the WGSL compiler says about a shader, at the places before linking.

use core::fmt;
use core::ops::Range;
use std::error::Error;

use naga::front::wgsl::ParseError;
use naga::valid::ValidationError;

use crate::link::file::definitions;
use crate::link::tokens::{Token, tokens};
use crate::{Linked, Location};

/// A message about a shader, with the places that it is about.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// The file that was validated.
    pub file: String,
    /// What is wrong.
    pub message: String,
    /// The places, the most telling one first. Empty if the compiler gives none.
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
        module: &naga::Module,
        error: &naga::WithSpan<ValidationError>,
    ) -> Self {
        let mut labels: Vec<_> = error
            .spans()
            .filter_map(|(span, text)| {
                // Names of naga's types and handles say nothing to the author of a shader.
                let text = if text.starts_with("naga::") { "" } else { text };
                Label::new(linked, span.to_range()?, text)
            })
            .collect();
        // naga goes from the outside in.
        labels.reverse();
        let (message, culprit) = headline(module, error.as_inner());
        if labels.is_empty() {
            labels.extend(culprit.and_then(|word| find(linked, word)));
        }
        let mut notes = Vec::new();
        let mut cause = error.as_inner().source();
        while let Some(error) = cause {
            notes.push(error.to_string());
            cause = error.source();
        }
        Self {
            file: file.to_owned(),
            message,
            labels,
            notes,
        }
    }
}

/// What is not valid, and the word by which it is found in the text where naga gives no place.
fn headline<'a>(module: &naga::Module, error: &'a ValidationError) -> (String, Option<&'a str>) {
    use ValidationError as E;
    let of = |kind: &str, name: &'a str| (format!("{kind} `{name}` is not valid"), Some(name));
    match error {
        E::Function { name, .. } => of("function", name),
        E::EntryPoint { name, .. } => of("entry point", name),
        E::GlobalVariable { name, .. } => of("variable", name),
        E::Constant { name, .. } => of("constant", name),
        E::Override { name, .. } => of("override", name),
        E::Type { name, .. } if !name.is_empty() => of("type", name),
        E::Type { handle, .. } => {
            let ty = module.types.get_handle(*handle).ok();
            match ty.and_then(|ty| ty.inner.scalar()).and_then(scalar_name) {
                Some(name) => of("type", name),
                None => ("a type is not valid".to_owned(), None),
            }
        }
        other => (other.to_string(), None),
    }
}

/// Scalars that some profiles lack.
fn scalar_name(scalar: naga::Scalar) -> Option<&'static str> {
    match (scalar.kind, scalar.width) {
        (naga::ScalarKind::Float, 8) => Some("f64"),
        (naga::ScalarKind::Float, 2) => Some("f16"),
        (naga::ScalarKind::Sint, 8) => Some("i64"),
        (naga::ScalarKind::Uint, 8) => Some("u64"),
        _ => None,
    }
}

/// The definition of `word`, or else its first use.
fn find(linked: &Linked, word: &str) -> Option<Label> {
    let tokens = tokens(linked.wgsl()).unwrap_or_default();
    let defined = definitions(&tokens);
    let named = |token: &&Token<'_>| token.is_word(word);
    let token = defined
        .iter()
        .find(named)
        .or_else(|| tokens.iter().find(named))?;
    Label::new(linked, token.range(), "")
}

impl Label {
    /// The bytes `range` of the linked text. `None` for text that comes from no file.
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
