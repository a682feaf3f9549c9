//! How much of a picture's resolution is rendered.

use serde::{Deserialize, Serialize};

/// A part of the picture's resolution, along each side.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub enum Resolution {
    /// A texel for every pixel.
    #[default]
    Full,
    /// One for 2 x 2 pixels, rounded up.
    Half,
    /// One for 4 x 4 pixels, rounded up.
    Quarter,
}

impl Resolution {
    /// Pixels along each side of a texel.
    #[must_use]
    pub fn pixels_per_texel(self) -> u32 {
        match self {
            Resolution::Full => 1,
            Resolution::Half => 2,
            Resolution::Quarter => 4,
        }
    }
}
