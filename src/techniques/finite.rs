//! A finite number as a setting: settings are compared, and name pipelines.

use core::fmt;
use core::hash::{Hash, Hasher};

use serde::{Deserialize, Serialize};

use crate::ValueError;

/// A finite number. Equal numbers have equal hashes; there is neither NaN nor a negative zero.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd, Serialize, Deserialize)]
#[serde(try_from = "f32", into = "f32")]
pub struct Finite(pub(super) f32);

impl Finite {
    /// Zero.
    pub const ZERO: Finite = Finite(0.0);

    /// Wraps a number that is finite.
    pub fn new(value: f32) -> Result<Self, ValueError> {
        if !value.is_finite() {
            let message = format!("{value} is not a finite number");
            return Err(ValueError::new("a setting", message));
        }
        // Adding zero turns -0 into 0.
        Ok(Self(value + 0.0))
    }

    /// The value as a plain number.
    #[must_use]
    pub fn get(self) -> f32 {
        self.0
    }
}

#[cfg(feature = "schema")]
impl schemars::JsonSchema for Finite {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> std::borrow::Cow<'static, str> {
        "Finite".into()
    }

    fn json_schema(generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        f32::json_schema(generator)
    }
}

impl Eq for Finite {}

impl Hash for Finite {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.to_bits().hash(state);
    }
}

impl From<Finite> for f32 {
    fn from(value: Finite) -> f32 {
        value.0
    }
}

impl TryFrom<f32> for Finite {
    type Error = ValueError;

    fn try_from(value: f32) -> Result<Self, ValueError> {
        Self::new(value)
    }
}

impl fmt::Display for Finite {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}
