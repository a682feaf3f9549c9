//! What is in the air of a scene.

use moment_shadows::{SingleScattering, SingleScatteringError};

/// A homogeneous medium, and how far away it ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Air {
    /// The medium and the light in it.
    pub medium: SingleScattering,
    /// The distance along the camera's axis up to which light is scattered; sky is there.
    pub far: f64,
}

/// Extinction of the colours as parts of their mean: thicker for blue.
const COLOURS: [f32; 3] = [0.9, 1.0, 1.1];

/// How much of what is extinguished is scattered.
const ALBEDO: f32 = 0.9;

/// Irradiance of a surface that faces the sun.
const IRRADIANCE: [f32; 3] = [9.0, 8.4, 7.5];

impl Air {
    /// Thin haze of an optical thickness between the camera and the far end, lit by a sun.
    ///
    /// # Errors
    /// Thickness or anisotropy out of range.
    pub fn new(thickness: f64, anisotropy: f32, far: f64) -> Result<Self, SingleScatteringError> {
        let mean = (thickness / far) as f32;
        let extinction = COLOURS.map(|colour| colour * mean);
        let scattering = extinction.map(|extinction| ALBEDO * extinction);
        Ok(Self {
            medium: SingleScattering::new(extinction, scattering, anisotropy, IRRADIANCE)?,
            far,
        })
    }
}
