//! How a host's stored depth becomes moment depth.

use bytemuck::{Pod, Zeroable};
use serde::{Deserialize, Serialize};

use crate::ValueError;

/// Distances along the light's axis, in scene units, that map to the moment depths -1 and 1.
///
/// The tighter the range encloses casters and receivers, the less light leaks.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DepthRange {
    /// Distance of moment depth -1.
    pub near: f64,
    /// Distance of moment depth 1; greater than `near`.
    pub far: f64,
}

/// How stored depth becomes moment depth: the uniform struct of the WGSL module `depth`, one per layer of a map.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable, Serialize, Deserialize)]
#[repr(C)]
pub struct DepthConversion {
    /// Numerator where the scaled stored depth is 0 and 1.
    pub numerator: [f32; 2],
    /// Denominator where the scaled stored depth is 0 and 1.
    pub denominator: [f32; 2],
    /// Factor of the stored depth.
    pub scale: f32,
    /// Summand after the factor.
    pub offset: f32,
    /// Unused; keeps the WGSL layout.
    pub padding: [f32; 2],
}

impl DepthConversion {
    /// Orthographic depth in [0, 1], 0 at the near plane. Moment depth -1 and 1 are the near and the far plane.
    #[must_use]
    pub fn orthographic() -> Self {
        Self::of_ends([-1.0, 1.0], [1.0, 1.0])
    }

    /// Perspective depth in [0, 1], 0 at the near plane. `far` may be infinite.
    pub fn perspective(near: f64, far: f64, range: DepthRange) -> Result<Self, ValueError> {
        range.check()?;
        let valid = near.is_finite() && near > 0.0 && far > near;
        if !valid {
            let message = format!(
                "a perspective light cannot have its near plane at {near} and its far plane at {far}; \
                 the near plane lies in front of the light and before the far plane"
            );
            return Err(ValueError::new("the planes", message));
        }
        // Distance t = near / ((1 - d) + d near / far); moment depth = (2 t - (a + b)) / (b - a).
        let ratio = near / far;
        let (sum, extent) = (range.near + range.far, range.far - range.near);
        // Dividing by the near plane keeps the four numbers in f32 range for any unit of length.
        let ends = |weight: f64| ((2.0 * near - sum * weight) / near, extent * weight / near);
        let (numerator_near, denominator_near) = ends(1.0);
        let (numerator_far, denominator_far) = ends(ratio);
        Ok(Self::of_ends(
            [numerator_near, numerator_far],
            [denominator_near, denominator_far],
        ))
    }

    /// Distance along the light's axis (or to the light) in scene units, as an R32Float texture holds it.
    pub fn linear(range: DepthRange) -> Result<Self, ValueError> {
        range.check()?;
        let extent = range.far - range.near;
        Ok(Self {
            scale: (1.0 / extent) as f32,
            offset: (-range.near / extent) as f32,
            ..Self::orthographic()
        })
    }

    /// The conversion of the same light with stored depth reversed: 1 at the near plane.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self {
            numerator: [self.numerator[1], self.numerator[0]],
            denominator: [self.denominator[1], self.denominator[0]],
            ..self
        }
    }

    fn of_ends(numerator: [f64; 2], denominator: [f64; 2]) -> Self {
        // Only ratios matter: the largest becomes 1.
        let largest = numerator
            .iter()
            .chain(&denominator)
            .fold(0.0_f64, |largest, value| largest.max(value.abs()));
        let scaled = |pair: [f64; 2]| pair.map(|value| (value / largest) as f32);
        Self {
            numerator: scaled(numerator),
            denominator: scaled(denominator),
            scale: 1.0,
            offset: 0.0,
            padding: [0.0; 2],
        }
    }
}

impl DepthRange {
    /// Checks that the range is finite and not empty.
    pub fn check(self) -> Result<(), ValueError> {
        let valid = self.near.is_finite() && self.far.is_finite() && self.near < self.far;
        if valid {
            return Ok(());
        }
        let message = format!(
            "the depth range {} to {} is empty or not finite; give finite distances with near < far",
            self.near, self.far
        );
        Err(ValueError::new("the depth range", message))
    }
}
