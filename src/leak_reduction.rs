//! The host side of the WGSL module `leak_reduction`.

use bytemuck::{Pod, Zeroable};
use serde::{Deserialize, Serialize};

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

/// A leak reduction with a field out of range.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error("leak reduction: {name} is {value}, but must be {range}")]
pub struct LeakReductionError {
    /// The field's name.
    pub name: &'static str,
    /// The field's value.
    pub value: f32,
    /// The range that the value has to be in.
    pub range: &'static str,
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
    pub fn check(self) -> Result<(), LeakReductionError> {
        let fields = [
            (
                "full_shadow",
                self.full_shadow,
                self.full_shadow > 0.0 && self.full_shadow <= 1.0,
                "above 0 and at most 1",
            ),
            (
                "bleed_reduction",
                self.bleed_reduction,
                self.bleed_reduction >= 0.0 && self.bleed_reduction < 1.0,
                "at least 0 and below 1",
            ),
            (
                "visibility_exponent",
                self.visibility_exponent,
                self.visibility_exponent > 0.0 && self.visibility_exponent.is_finite(),
                "above 0 and finite",
            ),
        ];
        match fields.into_iter().find(|(_, _, valid, _)| !valid) {
            None => Ok(()),
            Some((name, value, _, range)) => Err(LeakReductionError { name, value, range }),
        }
    }
}

impl Default for LeakReduction {
    fn default() -> Self {
        Self::DEFAULT
    }
}
