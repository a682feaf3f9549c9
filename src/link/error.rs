//! What is wrong with a shader, and where.

use core::fmt;

use super::rule::Rule;
use crate::Location;

/// A shader that is refused: by the rules of imports, by the WGSL compiler, by a profile, or by a backend.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShaderError {
    /// The rule that is broken.
    pub rule: Rule,
    /// What is wrong, and what to do about it.
    pub message: String,
    /// The places in the files before linking, the most telling one first. Empty if the compiler gives none.
    pub places: Vec<Location>,
    /// Further sentences: causes, and next steps.
    pub notes: Vec<String>,
}

impl ShaderError {
    /// An error without a place.
    pub(crate) fn new(rule: Rule, message: impl Into<String>) -> Self {
        Self {
            rule,
            message: message.into(),
            places: Vec::new(),
            notes: Vec::new(),
        }
    }

    pub(crate) fn at(rule: Rule, place: Location, message: impl Into<String>) -> Self {
        Self {
            places: vec![place],
            ..Self::new(rule, message)
        }
    }

    /// An error about the file of that name, for one that has no place in it.
    #[cfg(feature = "validate")]
    pub(crate) fn in_file(&mut self, file: &str) {
        if self.places.is_empty() {
            self.message = format!("{}\n --> {file}", self.message);
        }
    }
}

impl core::error::Error for ShaderError {}

impl fmt::Display for ShaderError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        for place in &self.places {
            write!(f, "\n{place}")?;
        }
        for note in &self.notes {
            write!(f, "\n = {note}")?;
        }
        Ok(())
    }
}
