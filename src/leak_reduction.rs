//! The host side of the WGSL module `leak_reduction`.

use bytemuck::{Pod, Zeroable};
use serde::{Deserialize, Serialize};

use crate::ValueError;
use crate::value_error::check;

const OF: &str = "leak reduction";

/// The reduction of light leaking after the bound: the uniform struct of the WGSL module `leak_reduction`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable, Serialize, Deserialize)]
#[repr(C)]
pub struct LeakReduction {
    /// Shadow intensity that counts as full shadow, in (0, 1]; 0.98 hides weak leaks (Peters, GDC 2016).
    pub full_shadow: f32,
    /// Visibility that counts as zero, in [0, 1) (Lauritzen, thesis 2008, section 3.4).
    pub bleed_reduction: f32,
    /// Exponent of visibility, above 0.
    pub visibility_exponent: f32,
    /// Unused; keeps the WGSL layout.
    pub padding: f32,
}

impl LeakReduction {
    /// Division by 0.98 alone.
    pub const DEFAULT: LeakReduction = LeakReduction {
        full_shadow: 0.98,
        bleed_reduction: 0.0,
        visibility_exponent: 1.0,
        padding: 0.0,
    };

    /// No reduction: the bound as it is.
    pub const NONE: LeakReduction = LeakReduction {
        full_shadow: 1.0,
        ..LeakReduction::DEFAULT
    };

    /// Checks that every field is in its range.
    pub fn check(self) -> Result<(), ValueError> {
        let full = self.full_shadow;
        let valid = full > 0.0 && full <= 1.0;
        check(valid, OF, "full_shadow", full, "above 0 and at most 1")?;
        let bleed = self.bleed_reduction;
        let valid = (0.0..1.0).contains(&bleed);
        let range = "at least 0 and below 1";
        check(valid, OF, "bleed_reduction", bleed, range)?;
        let exponent = self.visibility_exponent;
        let valid = exponent > 0.0 && exponent.is_finite();
        let range = "above 0 and finite";
        check(valid, OF, "visibility_exponent", exponent, range)
    }
}

impl Default for LeakReduction {
    fn default() -> Self {
        Self::DEFAULT
    }
}
