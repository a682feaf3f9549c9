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
    /// How far from the light the nearest caster is, where it is known: a view is refused that may begin behind it.
    pub nearest_caster: Option<f64>,
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
        let (near, far, reversed, begins) = match self.depth {
            LightDepth::Perspective {
                near,
                far,
                reversed,
                range,
            } => {
                DepthConversion::perspective(near, far, range)?;
                (near, far, reversed, near.max(range.near))
            }
            LightDepth::Linear { range } => {
                DepthConversion::perspective(range.near, range.far, range)?;
                (range.near, range.far, false, range.near)
            }
            LightDepth::Orthographic { .. } => {
                let message = "rays from a point are not parallel: depth is perspective or linear";
                return Err(ValueError::new("depth", message));
            }
        };
        let texels = f64::from(self.tile.texels);
        let across = f64::from(self.tile.texels - 2 * guard) / (texels * tangent);
        self.check_nearest_caster(begins, across)?;
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

    /// Checks that a view whose planes and range begin at a distance along its axis begins in front of all casters: in its corners they
    /// are farthest from the light at that distance.
    fn check_nearest_caster(&self, begins: f64, across: f64) -> Result<(), ValueError> {
        let Some(distance) = self.nearest_caster else {
            return Ok(());
        };
        let valid = distance > 0.0;
        check(
            valid,
            "a point light",
            "nearest_caster",
            distance,
            "above 0",
        )?;
        let along = distance / (1.0 + 2.0 / (across * across)).sqrt();
        if begins <= along {
            return Ok(());
        }
        let message = format!(
            "a caster {distance} from the light may lie {along} along the axis of a view, which begins at {begins} (its near plane and \
             its range); let them begin no farther away than the caster, or move the caster"
        );
        Err(ValueError::new("nearest_caster", message))
    }
}
