//! The host side of the WGSL module `receiver_bias`.

use bytemuck::{Pod, Zeroable};
use serde::{Deserialize, Serialize};

use crate::constants::RECEIVER_BIAS_STANDARD_DEVIATIONS;
use crate::{DepthConversion, TextureFormat};

/// The variance, in squared texels along either axis, that multisampling and bilinear lookup add to a kernel's: 1/12 for
/// samples spread evenly over a texel, at most 1/4 for a lookup half-way between texels.
const VARIANCE_OF_SAMPLING: f32 = 1.0 / 12.0 + 1.0 / 4.0;

/// The steepest slope against the light that is still biased in full: 85 degrees.
const STEEPEST_TANGENT: f32 = 11.43;

/// The error of stored depths and reconstructed positions, in moment depth: half a step of 16-bit depth is 1.5e-5, and about
/// as much again is lost on the way to the light's space and back.
const DEPTH_ERROR: f32 = 3e-5;

/// The receiver bias: the uniform struct of the WGSL module `receiver_bias`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable, Serialize, Deserialize)]
#[repr(C)]
pub struct ReceiverBias {
    /// Moment depth that is always subtracted.
    pub constant: f32,
    /// Multiplies the length of the gradient of moment depth per texel.
    pub slope_scale: f32,
    /// The largest bias in moment depth.
    pub maximum: f32,
    /// Unused; keeps the WGSL layout.
    pub padding: f32,
    /// One step of the light's stored depth is `(step_root[0] + step_root[1] z)^2` of moment depth, at the moment depth z.
    pub step_root: [f32; 2],
    /// Unused; keeps the WGSL layout.
    pub padding_of_step: [f32; 2],
}

impl ReceiverBias {
    /// How many standard deviations of depth under the kernel a receiver moves towards the light.
    ///
    /// One suffices for a symmetric distribution: a fragment in front of the lower Gauss node, which then lies one standard
    /// deviation in front of the mean, has a lower bound of exactly 0 (Peters & Klein, i3D 2015, Algorithm 3). The rest
    /// covers the moment bias and the rounding of storage.
    pub const STANDARD_DEVIATIONS: f32 = RECEIVER_BIAS_STANDARD_DEVIATIONS;

    /// No bias at all: for maps whose casters are not receivers.
    pub const NONE: ReceiverBias = ReceiverBias {
        constant: 0.0,
        slope_scale: 0.0,
        maximum: 0.0,
        padding: 0.0,
        step_root: [0.0; 2],
        padding_of_step: [0.0; 2],
    };

    /// The bias that follows from a kernel, for all scenes.
    ///
    /// `standard_deviation` is the kernel's along one axis in texels of the map ([`crate::Kernel::standard_deviation`];
    /// 0 for a map that is not blurred). `depth_per_texel` is the moment depth that a texel's width corresponds to along
    /// the light's axis: width times 2 / (far - near); for a spot light at the far end of the range.
    #[must_use]
    pub fn for_kernel(standard_deviation: f32, depth_per_texel: f32) -> Self {
        let variance = standard_deviation * standard_deviation + VARIANCE_OF_SAMPLING;
        let slope_scale = Self::STANDARD_DEVIATIONS * variance.sqrt();
        Self {
            constant: DEPTH_ERROR,
            slope_scale,
            maximum: DEPTH_ERROR + slope_scale * STEEPEST_TANGENT * depth_per_texel,
            ..Self::NONE
        }
    }

    /// This bias for a light whose depth map has the format `format`: 16 bits of hyperbolic depth are coarse far from the
    /// near plane.
    #[must_use]
    pub fn for_stored_depth(self, format: TextureFormat, conversion: &DepthConversion) -> Self {
        let step = match format.depth_step() {
            Some(step) => step * f64::from(conversion.scale.abs()),
            None => return self,
        };
        // z(d) = n / m with n and m linear in d, so |dz/dd| = (n' - z m')^2 / |m' n(0) - n' m(0)|.
        let [numerator, denominator] = [conversion.numerator, conversion.denominator];
        let change = |ends: [f32; 2]| f64::from(ends[1]) - f64::from(ends[0]);
        let (n, m) = (change(numerator), change(denominator));
        let determinant = m * f64::from(numerator[0]) - n * f64::from(denominator[0]);
        let factor = (step / determinant.abs().max(f64::from(f32::MIN_POSITIVE))).sqrt();
        let root = [n * factor, -m * factor].map(|value| value as f32);
        Self {
            step_root: if root.iter().all(|value| value.is_finite()) {
                root
            } else {
                [0.0; 2]
            },
            ..self
        }
    }
}
