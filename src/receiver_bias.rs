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
    /// How coarsely the light's depth is stored, in two numbers of 16 bits ([`for_stored_depth`](Self::for_stored_depth)).
    pub step: u32,
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
        step: 0,
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
    /// near plane. Reversed floats are nowhere: their steps shrink with the depth that they store.
    #[must_use]
    pub fn for_stored_depth(self, format: TextureFormat, conversion: &DepthConversion) -> Self {
        let [n0, n1] = conversion.numerator.map(f64::from);
        let [m0, m1] = conversion.denominator.map(f64::from);
        let offset = f64::from(conversion.offset);
        let step = match format.depth_step() {
            Some(_) if format.is_floating_depth() && n1 * m0 < n0 * m1 => return self,
            // Its share of the largest number that is stored, near plane or far.
            Some(step) if format.is_floating_depth() => {
                step * offset.abs().max((1.0 - offset).abs())
            }
            Some(step) => step * f64::from(conversion.scale.abs()),
            None => return self,
        };
        // z(d) = n / m with n and m linear in d, so |dz/dd| = (n' - z m')^2 / |m' n0 - n' m0|.
        let determinant = ((m1 - m0) * n0 - (n1 - n0) * m0).abs();
        let factor = (step / determinant.max(f64::MIN_POSITIVE)).sqrt();
        // As WGSL's unpack2x16snorm has it, of half the numbers: both ends of the range are at most 2 moment depths coarse.
        let packed = |root: f64| (root * factor * 0.5 * 32767.0).round() as i16 as u16;
        let [root, slope] = [n1 - n0, m0 - m1].map(packed);
        Self {
            step: u32::from(root) | u32::from(slope) << 16,
            ..self
        }
    }
}
