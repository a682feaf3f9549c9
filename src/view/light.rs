//! A view of a light, and how its map stores depth.

use glam::{DMat4, DVec4};
use serde::{Deserialize, Serialize};

use super::wide;
use crate::{DepthConversion, DepthRange, MapRegion, ValueError};

/// A view of a light: what one region of its map was drawn with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LightView {
    /// From scene to clip space, by columns, as the map was drawn with.
    pub clip_from_world: [[f32; 4]; 4],
    /// How the map stores depth.
    pub depth: LightDepth,
    /// The layer of the map of moments.
    pub layer: u32,
    /// The region of that layer that the matrix's clip space covers; [`MapRegion::WHOLE`] where it has the layer to itself.
    pub region: MapRegion,
    /// The light's channel in the node's output, 0 to 3.
    pub channel: u32,
}

/// How a light's depth map stores depth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LightDepth {
    /// Linear from the near plane (moment depth -1) to the far plane (moment depth 1).
    Orthographic {
        /// Whether 1 is stored at the near plane.
        reversed: bool,
    },
    /// Hyperbolic; clip space w is the distance along the light's axis.
    Perspective {
        /// Distance of the near plane, above 0.
        near: f64,
        /// Distance of the far plane; may be infinite.
        far: f64,
        /// Whether 1 is stored at the near plane.
        reversed: bool,
        /// The distances that map to the moment depths -1 and 1.
        range: DepthRange,
    },
}

impl LightDepth {
    /// The conversion that `resolve` applies to the map.
    pub fn conversion(&self) -> Result<DepthConversion, ValueError> {
        let (forward, reversed) = match *self {
            LightDepth::Orthographic { reversed } => (DepthConversion::orthographic(), reversed),
            LightDepth::Perspective {
                near,
                far,
                reversed,
                range,
            } => (DepthConversion::perspective(near, far, range)?, reversed),
        };
        Ok(if reversed {
            forward.reversed()
        } else {
            forward
        })
    }

    /// The linear function of a scene position (x, y, z, 1) that gives its moment depth, for the map's matrix.
    ///
    /// Moment depth is linear in the scene whatever the map stores, so a fragment's needs no stored depth.
    #[must_use]
    pub fn moment_depth_row(&self, clip_from_world: &[[f32; 4]; 4]) -> [f32; 4] {
        self.row(wide(clip_from_world)).as_vec4().to_array()
    }

    /// [`moment_depth_row`](Self::moment_depth_row) in f64.
    pub(super) fn row(&self, clip_from_world: DMat4) -> DVec4 {
        let (axis, factor, summand) = match *self {
            LightDepth::Orthographic { reversed } => {
                let sign = if reversed { -1.0 } else { 1.0 };
                (clip_from_world.row(2), 2.0 * sign, -sign)
            }
            LightDepth::Perspective { range, .. } => {
                let extent = range.far - range.near;
                (
                    clip_from_world.row(3),
                    2.0 / extent,
                    -(range.near + range.far) / extent,
                )
            }
        };
        axis * factor + summand * DVec4::W
    }
}
