//! What sub-commands print, and what they say beside it.

use std::fmt::Display;
use std::io::{self, Write};

use super::CommandError;

/// Prints a line.
pub(super) fn print(text: impl Display) -> Result<(), CommandError> {
    writeln!(io::stdout().lock(), "{text}").map_err(CommandError::Output)
}

/// Says a line to whoever may listen.
pub(super) fn say(text: impl Display) {
    let _ = writeln!(io::stderr().lock(), "{text}");
}
