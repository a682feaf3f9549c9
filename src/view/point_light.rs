//! Views of a light that shines from a point: a spot, or six faces.

use glam::{DMat4, DVec3, DVec4};

use super::rectified::axes_of;
use super::{LightView, Tile, light_direction};
use crate::value_error::check;
use crate::{DepthConversion, LightDepth, ValueError};

/// A light that shines from a point: to all sides, or as a spot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointLight {
    /// Where it is.
    pub position: [f64; 3],
    /// How its maps store depth, by [`LightDepth::Perspective`] or [`LightDepth::Linear`]; the planes of projections are then
    /// those of the range, which has to begin in front of the light.
    pub depth: LightDepth,
    /// The region that each view gets.
    pub tile: Tile,
}

impl PointLight {
    /// The view of a spot that shines along `direction` (of any length); `angle` is the full angle of its cone in radians,
    /// above 0 and below pi. Within the guard band the region shows the square around the cone.
    ///
    /// # Errors
    /// [`ValueError`] about the `light_direction`, the `angle` or a field.
    pub fn spot(&self, direction: [f64; 3], angle: f64) -> Result<LightView, ValueError> {
        let forward = light_direction(direction)?;
        let valid = angle > 0.0 && angle < core::f64::consts::PI;
        check(
            valid,
            "a spot",
            "angle",
            angle,
            "above 0 and below pi radians",
        )?;
        let [up, right, forward] = axes_of(forward);
        self.view([right, up, forward], (0.5 * angle).tan())
    }

    /// The views of the six faces, +x, -x, +y, -y, +z and -z. Within their guard bands they meet at their edges; with them,
    /// each has a wider angle than a quarter turn.
    ///
    /// # Errors
    /// [`ValueError`] about a field.
    pub fn faces(&self) -> Result<[LightView; 6], ValueError> {
        let face = |axis: usize, sign: f64| {
            let forward = sign * DVec3::AXES[axis];
            let up = DVec3::AXES[if axis == 1 { 2 } else { 1 }];
            self.view([forward.cross(up), up, forward], 1.0)
        };
        Ok([
            face(0, 1.0)?,
            face(0, -1.0)?,
            face(1, 1.0)?,
            face(1, -1.0)?,
            face(2, 1.0)?,
            face(2, -1.0)?,
        ])
    }

    /// A view along the last of the axes; `tangent` is that of half the angle within the guard band.
    fn view(
        &self,
        [right, up, forward]: [DVec3; 3],
        tangent: f64,
    ) -> Result<LightView, ValueError> {
        let guard = self.tile.guard()?;
        let position = DVec3::from(self.position);
        let range = "finite";
        check(
            position.is_finite(),
            "a point light",
            "position",
            position,
            range,
        )?;
        let (near, far, reversed) = match self.depth {
            LightDepth::Perspective {
                near,
                far,
                reversed,
                range,
            } => {
                DepthConversion::perspective(near, far, range)?;
                (near, far, reversed)
            }
            LightDepth::Linear { range } => {
                DepthConversion::perspective(range.near, range.far, range)?;
                (range.near, range.far, false)
            }
            LightDepth::Orthographic { .. } => {
                let message = "rays from a point are not parallel: depth is perspective or linear";
                return Err(ValueError::new("depth", message));
            }
        };
        let texels = f64::from(self.tile.texels);
        let across = f64::from(self.tile.texels - 2 * guard) / (texels * tangent);
        let row = |axis: DVec3| axis.extend(-axis.dot(position));
        let w = row(forward);
        // (distance - near) / (1 - near / far), and what is left of the distance where depth is reversed.
        let ratio = near / far;
        let (along, constant) = if reversed {
            (-ratio, near)
        } else {
            (1.0, -near)
        };
        let z = (w * along + constant * DVec4::W) / (1.0 - ratio);
        let rows = [across * row(right), across * row(up), z, w];
        let clip = DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose();
        Ok(LightView {
            depth: self.depth,
            region: self.tile.region(),
            guard,
            ..LightView::orthographic(clip.to_cols_array_2d())
        })
    }
}
