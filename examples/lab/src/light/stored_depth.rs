//! How depth textures store distance, and the projections that make them do so.

use glam::{DMat4, DVec2, DVec4};

/// How a depth texture stores the distance along the light's axis. Stored depth is in `[0, 1]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StoredDepth {
    /// Linear in distance: 0 at `near` and 1 at `far`, the other way round if `reversed`.
    Orthographic {
        /// Distance along the axis of the near plane.
        near: f64,
        /// Distance along the axis of the far plane.
        far: f64,
        /// Whether the near plane is stored as 1.
        reversed: bool,
    },
    /// Hyperbolic in distance: 0 at `near` and 1 at `far`, the other way round if `reversed`.
    Perspective {
        /// Distance along the axis of the near plane.
        near: f64,
        /// Distance along the axis of the far plane; `None` for an infinite one.
        far: Option<f64>,
        /// Whether the near plane is stored as 1.
        reversed: bool,
    },
}

impl StoredDepth {
    /// Whether the near plane is stored as 1.
    pub fn reversed(&self) -> bool {
        match *self {
            Self::Orthographic { reversed, .. } | Self::Perspective { reversed, .. } => reversed,
        }
    }

    /// The stored depth of the far plane: what a map is cleared to.
    pub fn cleared(&self) -> f64 {
        if self.reversed() { 0.0 } else { 1.0 }
    }

    /// The distance along the axis that `stored` in `[0, 1]` stands for; infinite at an infinite far plane.
    pub fn distance(&self, stored: f64) -> f64 {
        match *self {
            Self::Orthographic {
                near,
                far,
                reversed,
            } => {
                let fraction = if reversed { 1.0 - stored } else { stored };
                near + fraction * (far - near)
            }
            // Each form subtracts only where the texture itself has lost the digits.
            Self::Perspective {
                near,
                far: Some(far),
                reversed: false,
            } => near * far / (far - stored * (far - near)),
            Self::Perspective {
                near,
                far: Some(far),
                reversed: true,
            } => near * far / (near + stored * (far - near)),
            Self::Perspective {
                near,
                far: None,
                reversed: false,
            } => near / (1.0 - stored),
            Self::Perspective {
                near,
                far: None,
                reversed: true,
            } => near / stored,
        }
    }

    /// Rows z and w of the clip matrix as applied to (x, y, z, 1) in view space: `(z·z, z·1, w·z, w·1)`.
    fn clip_terms(&self) -> [f64; 4] {
        // With d = -z the forward forms are (d - near) / (far - near) and (far (d - near)) / (far - near) / d.
        match *self {
            Self::Orthographic {
                near,
                far,
                reversed,
            } => {
                let scale = 1.0 / (far - near);
                if reversed {
                    [scale, far * scale, 0.0, 1.0]
                } else {
                    [-scale, -near * scale, 0.0, 1.0]
                }
            }
            Self::Perspective {
                near,
                far,
                reversed,
            } => match (far, reversed) {
                (Some(far), false) => {
                    let scale = far / (far - near);
                    [-scale, -near * scale, -1.0, 0.0]
                }
                (Some(far), true) => {
                    let scale = near / (far - near);
                    [scale, far * scale, -1.0, 0.0]
                }
                (None, false) => [-1.0, -near, -1.0, 0.0],
                (None, true) => [0.0, near, -1.0, 0.0],
            },
        }
    }

    /// The projection from view space (right-handed, looking along -z) to clip space, for given scales of x and y.
    pub fn clip_from_view(&self, scale: DVec2) -> DMat4 {
        let [z_z, z_1, w_z, w_1] = self.clip_terms();
        DMat4::from_cols(
            DVec4::new(scale.x, 0.0, 0.0, 0.0),
            DVec4::new(0.0, scale.y, 0.0, 0.0),
            DVec4::new(0.0, 0.0, z_z, w_z),
            DVec4::new(0.0, 0.0, z_1, w_1),
        )
    }
}
