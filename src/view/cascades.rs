//! The cascades of a sun: views of one light, each for a part of what a camera sees.

use glam::{DMat4, DVec2, DVec3, DVec4};

use super::border::WIDEST;
use super::frustum::Frustum;
use super::rectified::axes_of;
use super::{Border, CameraView, CascadeSplits, LightView, Tile, light_direction};
use crate::value_error::check;
use crate::{LightDepth, ValueError};

/// By how much spheres grow, so that rounding in a host's f32 matrices does not change the size of texels.
const GROWTH: f64 = 1.0 + 1.0 / 65536.0;

/// Steps of a cascade's range in which it moves along the light. A power of two: what fits ranges to their casters works on such a grid, which
/// then stays where it is in the scene.
const STEPS: f64 = 16.0;

/// Places farther from the scene's origin have less than 12 bits within a texel.
const FARTHEST: f64 = (1_u64 << 40) as f64;

/// The cascades of a sun: views of one light, each for a part of what a camera sees, a *slice* of its frustum.
///
/// The same cascades for any camera with this projection. As the camera moves and turns texels keep their size and stay where
/// they are in the scene: a cascade covers the sphere around its slice, and moves by whole texels, along the light by whole sixteenths of
/// its range. As the light turns they do not.
#[derive(Clone, Debug, PartialEq)]
pub struct Cascades {
    /// Where light travels to, of any length.
    pub direction: [f64; 3],
    /// Where cascades end.
    pub splits: CascadeSplits,
    /// Where the first begins, a distance along the camera's axis from the camera, at least 0; from its near plane, where the
    /// camera's rays are parallel.
    pub near: f64,
    /// Where the last ends: beyond is no shadow.
    pub far: f64,
    /// How far a cascade reaches into the next one, as a part of its own length, 0 to 1: room to blend between them.
    pub overlap: f64,
    /// The part of a view's width along its border over which it blends with coarser ones, and the last one fades out, 0 to 0.5;
    /// 0 for sharp borders.
    pub blend: f64,
    /// The lowest and the highest corner of a box around all that casts. Maps and their ranges are no larger than it; without
    /// it ranges are the spheres', and a fifteenth longer.
    pub casters: Option<[[f64; 3]; 2]>,
    /// Whether casters in front of the near plane are clamped to it (`unclipped_depth` of wgpu), so that it may lie at the
    /// slice. Without it, near planes lie in front of all casters, and light leaks in proportion.
    pub pancaking: bool,
    /// Whether maps store 1 at the near plane.
    pub reversed: bool,
    /// The region that each cascade gets.
    pub tile: Tile,
}

impl Cascades {
    /// Where each slice begins and ends, its overlap with the next one included.
    ///
    /// # Errors
    /// [`ValueError`] about `near`, `far`, `overlap` or the splits.
    pub fn slices(&self) -> Result<Vec<[f64; 2]>, ValueError> {
        let Self {
            near, far, overlap, ..
        } = *self;
        let check = |valid, name, value, range| check(valid, "cascades", name, value, range);
        check(
            near >= 0.0 && near < far,
            "near",
            near,
            "at least 0 and below far",
        )?;
        check(far.is_finite(), "far", far, "finite")?;
        check((0.0..=1.0).contains(&overlap), "overlap", overlap, "0 to 1")?;
        let ends = self.splits.ends(near, far)?;
        let slice = |pair: &[f64]| [pair[0], (pair[1] + overlap * (pair[1] - pair[0])).min(far)];
        Ok(ends.windows(2).map(slice).collect())
    }

    /// The views, from near to far: of the views that contain a pixel the first shades it. They have no places yet;
    /// [`Atlas::place`](crate::Atlas::place) gives them.
    ///
    /// # Errors
    /// [`ValueError`] about the `camera`, `casters`, `light_direction`, `texels` or another field.
    pub fn views(&self, camera: &CameraView) -> Result<Vec<LightView>, ValueError> {
        let slices = self.slices()?;
        let guard = self.tile.guard()?;
        let texels = self.tile.texels;
        let range = "2 texels more than the guard bands";
        check(texels - 2 * guard > 1, "cascades", "texels", texels, range)?;
        let blend = self.blend;
        let width = blend * f64::from(texels - 2 * guard);
        let valid = (0.0..=0.5).contains(&blend) && width <= WIDEST;
        let range = "0 to 0.5, and at most 4095 texels of a view";
        check(valid, "cascades", "blend", blend, range)?;
        let axes = axes_of(light_direction(self.direction)?);
        let casters = self.casters(&axes)?;
        let frustum = Frustum::new(camera)?;
        let spheres = slices.into_iter().map(|slice| frustum.sphere(slice));
        let views =
            spheres.map(|(centre, radius)| self.view(&axes, centre, radius, casters, guard));
        let mut views = views.collect::<Result<Vec<_>, _>>()?;
        if let ([finer @ .., last], true) = (views.as_mut_slice(), blend > 0.0) {
            finer
                .iter_mut()
                .for_each(|view| view.border = Border::Blend(width));
            last.border = Border::Fade(width);
        }
        Ok(views)
    }

    /// The lowest and the highest coordinates of the casters in the light's axes.
    fn casters(&self, axes: &[DVec3; 3]) -> Result<Option<[DVec3; 2]>, ValueError> {
        let refuse = |message| Err(ValueError::new("casters", message));
        let Some([low, high]) = self.casters.map(|corners| corners.map(DVec3::from)) else {
            if self.pancaking {
                return Ok(None);
            }
            return refuse(
                "without pancaking near planes lie in front of all casters; give a box around them"
                    .to_owned(),
            );
        };
        // False for what is no number.
        if !(low.is_finite() && high.is_finite() && low.cmple(high).all()) {
            return refuse(format!(
                "the box around the casters goes from {low} to {high}; give its lowest and its highest corner, finite"
            ));
        }
        // Along an axis, the middle of a box and half its extent.
        let along = |axis: DVec3| {
            (
                axis.dot(0.5 * (low + high)),
                axis.abs().dot(0.5 * (high - low)),
            )
        };
        let ends = axes.map(along);
        Ok(Some([-1.0, 1.0].map(|sign| {
            DVec3::from(ends.map(|(middle, half)| middle + sign * half))
        })))
    }

    /// The view around a sphere.
    fn view(
        &self,
        axes: &[DVec3; 3],
        centre: DVec3,
        radius: f64,
        casters: Option<[DVec3; 2]>,
        guard: u32,
    ) -> Result<LightView, ValueError> {
        let inner = f64::from(self.tile.texels - 2 * guard);
        // One texel is lost to snapping.
        let texel_for = |side: f64| rounded_up(GROWTH * side / (inner - 1.0));
        let mut texel = texel_for(2.0 * radius);
        let centre = DVec3::from(axes.map(|axis| axis.dot(centre)));
        let mut middle = centre.truncate();
        // One step is lost to snapping.
        let step = rounded_up(inner * texel / (STEPS - 1.0));
        let depth = (centre.z / step).round();
        let [mut near, mut far] = [-0.5, 0.5].map(|half| (depth + half * STEPS) * step);
        if let Some([low, high]) = casters {
            // A texel more, for rounding.
            let (first, last) = (near.max(low.z - texel), far.min(high.z + texel));
            if first < last {
                (near, far) = (first, last);
            }
            if !self.pancaking {
                near = near.min(low.z - texel);
            }
            let side = (high - low).truncate().max_element();
            let fitted = texel_for(side).max(texel / 1024.0);
            if fitted < texel {
                (texel, middle) = (fitted, 0.5 * (low + high).truncate());
            }
        }
        let origin: DVec2 = (middle / texel).round() * texel;
        let across = 2.0 / (f64::from(self.tile.texels) * texel);
        // The light's first axis is up, so that the matrix mirrors nothing.
        let [up, right, along] = *axes;
        let extent = far - near;
        let z = if self.reversed {
            (-along / extent).extend(far / extent)
        } else {
            (along / extent).extend(-near / extent)
        };
        let x = across * right.extend(-origin.y);
        let y = across * up.extend(-origin.x);
        let clip = DMat4::from_cols(x, y, z, DVec4::W).transpose();
        let resolved = (origin / texel).abs().max_element() <= FARTHEST;
        if !(texel.is_normal() && resolved && clip.is_finite()) {
            let message = "the frustum is too large, too small or too far away for f64; choose another unit of length, or make \
                           positions relative to a place nearby";
            return Err(ValueError::new("camera", message));
        }
        Ok(LightView {
            depth: LightDepth::Orthographic {
                reversed: self.reversed,
            },
            region: self.tile.region(),
            guard,
            ..LightView::orthographic(clip.to_cols_array_2d())
        })
    }
}

/// The next number with 11 significant bits: whole multiples of it are exact, and rounding errors before do not change it.
fn rounded_up(length: f64) -> f64 {
    let rest = (1_u64 << 42) - 1;
    f64::from_bits((length.to_bits() + rest) & !rest)
}
