//! What can be asked of a filterable map.

use core::fmt;

use serde::{Deserialize, Serialize};

use crate::Storage;

/// A way to turn a filtered map into shadow intensity.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum Technique {
    /// The sharp lower bound from four moments on the real line (Peters & Klein, i3D 2015).
    #[default]
    Hamburger4,
}

impl Technique {
    /// The name in graph files and on command lines.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Technique::Hamburger4 => "hamburger4",
        }
    }

    /// The storages that the technique can read.
    #[must_use]
    pub fn storages(self) -> &'static [Storage] {
        match self {
            Technique::Hamburger4 => &Storage::ALL,
        }
    }
}

impl fmt::Display for Technique {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
