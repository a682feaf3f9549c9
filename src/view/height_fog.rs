//! The host side of the WGSL module `height_fog`.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;

use crate::ValueError;
use crate::value_error::check;

const OF: &str = "height fog";

/// Fog whose density falls exponentially with height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeightFog {
    /// Which way is up, of any length.
    pub up: [f64; 3],
    /// The height, along `up` from the scene's origin, at which the medium is as dense as its extinction and scattering say.
    pub height: f64,
    /// By how much the logarithm of the density falls per scene unit of height: one over the height in which it falls by a factor of
    /// e. 0 for a homogeneous medium.
    pub falloff: f64,
}

impl HeightFog {
    /// A medium of the same density everywhere.
    pub const NONE: HeightFog = HeightFog {
        up: [0.0, 1.0, 0.0],
        height: 0.0,
        falloff: 0.0,
    };

    /// The fog as a camera at a position of the scene sees it.
    ///
    /// # Errors
    /// [`ValueError`] about `up`, the `height` or the `falloff`.
    pub fn view(&self, camera: [f64; 3]) -> Result<HeightFogView, ValueError> {
        let up = super::rectified::normalized(DVec3::from(self.up)).ok_or_else(|| {
            let message = format!(
                "{OF}: up is {:?}, but must be finite and not zero: which way is up",
                self.up
            );
            ValueError::new("up", message)
        })?;
        let valid = (0.0..=LARGEST).contains(&self.falloff);
        check(
            valid,
            OF,
            "falloff",
            self.falloff,
            "at least 0 and at most 1e9",
        )?;
        check(self.height.is_finite(), OF, "height", self.height, "finite")?;
        let above = up.dot(DVec3::from(camera)) - self.height;
        // A homogeneous medium has none, however far away the camera is. Beyond the limits of the shader it may be anything.
        let log_density = -(self.falloff * above).clamp(-LARGEST, LARGEST);
        Ok(HeightFogView {
            gradient: (self.falloff * up).as_vec3().to_array(),
            log_density: log_density as f32,
        })
    }
}

/// The largest number that shaders are given.
const LARGEST: f64 = 1e9;

/// Height fog as a camera sees it: the uniform struct of the WGSL module `height_fog`. Made by [`HeightFog::view`].
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct HeightFogView {
    /// The fall of the density's logarithm per scene unit along each axis.
    pub gradient: [f32; 3],
    /// That logarithm at the camera.
    pub log_density: f32,
}
