//! What validation finds.

use core::fmt;

use super::Backend;
use crate::ShaderError;

/// What is wrong with a shader, and what each backend makes of it if nothing is.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ValidationReport {
    /// What makes the shader invalid, in the order of its lines.
    pub errors: Vec<ShaderError>,
    /// What would, but for the shader's own word on it (`diagnostic(warning, …)`).
    pub warnings: Vec<ShaderError>,
    /// Whether each of [`Backend::ALL`], in that order, can express the shader; empty for one that is not valid. What a language
    /// lacks is not an error, since no profile includes the two GLSL versions; the reason names the entry point.
    pub outcomes: Vec<(Backend, Result<(), String>)>,
}

impl ValidationReport {
    /// The longest text that is validated, in bytes, before and after linking.
    pub const LONGEST_SHADER: usize = 1 << 19;

    /// How many faults of the compiler's are looked for in a file.
    pub(super) const MOST_ERRORS: usize = 20;

    /// Whether nothing is wrong.
    #[must_use]
    pub fn is_valid(&self) -> bool {
        self.errors.is_empty()
    }

    /// The backends that the shader was written for.
    pub fn written(&self) -> impl Iterator<Item = Backend> {
        let written = self.outcomes.iter().filter(|(_, outcome)| outcome.is_ok());
        written.map(|(backend, _)| *backend)
    }

    pub(super) fn sort(&mut self) {
        for errors in [&mut self.errors, &mut self.warnings] {
            let place = |error: &ShaderError| {
                let first = error.places.first();
                first.map(|at| (at.file.clone(), at.line, at.column))
            };
            errors.sort_by_key(place);
            // Two checks may see one fault.
            errors.dedup_by(|one, other| place(one).is_some() && place(one) == place(other));
        }
    }
}

/// Each finding as the command prints it: `error[rule]: what is wrong`, with its places.
impl fmt::Display for ValidationReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let errors = self.errors.iter().map(|error| ("error", error));
        let warnings = self.warnings.iter().map(|warning| ("warning", warning));
        let mut gap = "";
        for (severity, found) in errors.chain(warnings) {
            write!(f, "{gap}{severity}[{}]: {found}", found.rule)?;
            gap = "\n\n";
        }
        Ok(())
    }
}
