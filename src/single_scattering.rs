//! The host side of the WGSL module `single_scattering`.

use bytemuck::{Pod, Zeroable};

use crate::ValueError;
use crate::value_error::check;

const OF: &str = "single scattering";

/// A homogeneous medium and the directional light in it: the uniform struct of the WGSL module `single_scattering`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct SingleScattering {
    /// Extinction per scene unit, by colour.
    pub extinction: [f32; 3],
    /// The anisotropy of the phase function, in [-0.99, 0.99].
    pub anisotropy: f32,
    /// Scattering per scene unit, by colour.
    pub scattering: [f32; 3],
    /// The extinction that shadows are weighted with: the mean of the colours.
    pub mean_extinction: f32,
    /// Irradiance of a surface that faces the light, by colour.
    pub irradiance: [f32; 3],
    /// Unused; keeps the WGSL layout.
    pub padding: f32,
}

impl SingleScattering {
    /// No medium: what is behind it stays as it is, to the bit.
    pub const NONE: SingleScattering = SingleScattering {
        extinction: [0.0; 3],
        anisotropy: 0.0,
        scattering: [0.0; 3],
        mean_extinction: 0.0,
        irradiance: [0.0; 3],
        padding: 0.0,
    };

    /// A medium with its extinction and scattering per scene unit by colour, each at least 0 and finite, and the anisotropy of
    /// its phase function from -0.99 (backwards) over 0 (isotropic) to 0.99 (forwards). `irradiance` is that of a surface that
    /// faces the light. Extinction of 0 scatters without loss.
    ///
    /// # Errors
    /// [`ValueError`], which names the number that is out of range.
    pub fn new(
        extinction: [f32; 3],
        scattering: [f32; 3],
        anisotropy: f32,
        irradiance: [f32; 3],
    ) -> Result<Self, ValueError> {
        for (name, values) in [
            ("the extinction", extinction),
            ("the scattering", scattering),
            ("the irradiance", irradiance),
        ] {
            for value in values {
                let valid = (0.0..=LARGEST).contains(&value);
                check(valid, OF, name, value, "at least 0 and at most 1e9")?;
            }
        }
        let valid = (-0.99..=0.99).contains(&anisotropy);
        check(
            valid,
            OF,
            "the anisotropy",
            anisotropy,
            "from -0.99 to 0.99",
        )?;
        Ok(Self {
            extinction,
            anisotropy,
            scattering,
            mean_extinction: extinction.iter().sum::<f32>() / 3.0,
            irradiance,
            padding: 0.0,
        })
    }
}

/// The largest parameter: products of three numbers up to this and a distance stay finite.
const LARGEST: f32 = 1e9;
