//! What is in the air of a scene.

use glam::DVec3;
use moment_shadows::{SingleScattering, ValueError};

use crate::scene::Scene;

/// Optical thickness between the camera and the far end.
pub(super) const THICKNESS: f64 = 0.7;

/// Anisotropy of the phase function.
const ANISOTROPY: f32 = 0.4;

/// How far behind the scene's middle the air ends, in parts of its radius.
const BEHIND: f64 = 1.5;

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
    /// Thin haze between a camera and a little behind the middle of the scene that it sees, lit by a sun.
    ///
    /// # Errors
    /// A medium that cannot be.
    pub(super) fn of(scene: &Scene, eye: DVec3) -> Result<Self, ValueError> {
        let bounds = scene.bounds();
        let far = (bounds.centre() - eye).length() + BEHIND * bounds.radius();
        let mean = (THICKNESS / far) as f32;
        let extinction = COLOURS.map(|colour| colour * mean);
        let scattering = extinction.map(|extinction| ALBEDO * extinction);
        Ok(Self {
            medium: SingleScattering::new(extinction, scattering, ANISOTROPY, IRRADIANCE)?,
            far,
        })
    }
}
