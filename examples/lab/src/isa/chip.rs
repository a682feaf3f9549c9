//! The chips that shaders are compiled for.

use serde::{Deserialize, Serialize};

/// A chip: one of each kind of instruction set that AMD has built for a decade. The ranks of shaders hardly differ
/// between chips of the same kind.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, clap::ValueEnum,
)]
#[serde(rename_all = "lowercase")]
pub enum Chip {
    /// RDNA 2.
    Navi21,
    /// GCN 5.
    Vega10,
}

impl Chip {
    /// Every chip.
    pub const ALL: [Chip; 2] = [Chip::Navi21, Chip::Vega10];

    /// The name, as the driver knows it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Chip::Navi21 => "navi21",
            Chip::Vega10 => "vega10",
        }
    }
}

impl core::fmt::Display for Chip {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(self.name())
    }
}
