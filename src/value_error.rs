//! Values that the library refuses.

use core::fmt::Display;

/// A value that is refused, alone or beside others: a parameter, a setting, a storage.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct ValueError {
    /// What the value is.
    pub name: &'static str,
    /// A sentence that says what is wrong with it and what is legal.
    pub message: String,
}

impl ValueError {
    /// The refusal of the value `name`, as a sentence that says what is legal.
    pub fn new(name: &'static str, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { name, message }
    }
}

/// Refuses a value that is not `valid`; `of` is what it belongs to.
pub(crate) fn check(
    valid: bool,
    of: &str,
    name: &'static str,
    value: impl Display,
    range: &str,
) -> Result<(), ValueError> {
    if valid {
        return Ok(());
    }
    let message = format!("{of}: {name} is {value}, but must be {range}");
    Err(ValueError::new(name, message))
}
