//! The host side of the WGSL module `punctual_light`.

use bytemuck::{Pod, Zeroable};
use glam::{DMat4, DVec3};

use super::{LightDepth, LightView, inverse};
use crate::value_error::check;
use crate::{LightSize, ValueError};

/// The cone of a spot, as full angles in radians: within the inner one it shines with all its light, at the outer one with none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpotCone {
    /// The angle of the inner cone, at least 0.
    pub inner: f64,
    /// The angle of the outer cone, above that of the inner one and below pi. What the view of the light shows contains it.
    pub outer: f64,
}

/// A light of which a camera sees the light in the air: the uniform struct of the WGSL module `punctual_light`.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct PunctualLight {
    /// Where the light is relative to the camera; of a directional light where it travels to.
    pub place: [f32; 3],
    /// The radius within which irradiance does not grow; 0 for a directional light.
    pub radius: f32,
    /// The axis of a spot's cone, scaled; zeros without a cone.
    pub cone_axis: [f32; 3],
    /// The summand of the attenuation within a cone; 1 without one.
    pub cone_offset: f32,
}

/// The radius of a light without a size, as a part of the distance up to which light is scattered: so near to it f32 still resolves
/// places on view rays.
const SMALLEST_RADIUS: f64 = 1.0 / 1024.0;

/// The largest size of a light.
const LARGEST: f64 = 1e9;

impl PunctualLight {
    /// The light of a view, which may be one of several of that light, and its cone if it is a spot. `eye` is the camera, and `far` how
    /// far from it light is scattered.
    ///
    /// # Errors
    /// [`ValueError`] about the `light`, its `depth`, its `size`, or the `cone`.
    pub fn new(
        light: &LightView,
        cone: Option<SpotCone>,
        eye: [f64; 3],
        far: f64,
    ) -> Result<Self, ValueError> {
        let clip = DMat4::from_cols_array_2d(&light.clip_from_world);
        let along_depth = inverse(clip, "light")?.z_axis;
        light.depth.check_matrix(clip)?;
        light.check_size()?;
        if matches!(light.depth, LightDepth::Orthographic { .. }) {
            if cone.is_some() {
                let message = "the light has parallel rays, but a cone is given; spots have perspective views";
                return Err(ValueError::new("cone", message));
            }
            let away = along_depth.truncate() * light.depth.row(clip).dot(along_depth);
            return Ok(Self {
                place: away.normalize_or_zero().as_vec3().to_array(),
                radius: 0.0,
                cone_axis: [0.0; 3],
                cone_offset: 1.0,
            });
        }
        // Its rays meet in what depth alone leads to.
        let position = along_depth.truncate() / along_depth.w;
        let sides = match light.size {
            LightSize::Disk(diameter) => [diameter; 2],
            LightSize::Rectangle(sides) => sides,
            LightSize::Point | LightSize::AngularDiameter(_) => [0.0; 2],
        };
        for side in sides {
            let valid = (0.0..=LARGEST).contains(&side);
            check(valid, "a light", "size", side, "at least 0 and at most 1e9")?;
        }
        let radius = 0.5 * sides[0].min(sides[1]);
        let axis = clip.row(3).truncate().normalize_or_zero();
        let (cone_axis, cone_offset) = match cone {
            None => (DVec3::ZERO, 1.0),
            Some(cone) => {
                let scale = cone.scale()?;
                (scale * axis, -scale * (0.5 * cone.outer).cos())
            }
        };
        Ok(Self {
            place: (position - DVec3::from(eye)).as_vec3().to_array(),
            radius: radius.max(SMALLEST_RADIUS * far) as f32,
            cone_axis: cone_axis.as_vec3().to_array(),
            cone_offset: cone_offset as f32,
        })
    }
}

/// The narrowest border of a cone, as a difference of cosines.
const NARROWEST: f64 = 1e-3;

impl SpotCone {
    /// One over the difference of the cosines of half the angles.
    fn scale(self) -> Result<f64, ValueError> {
        let Self { inner, outer } = self;
        let of = "the cone of a spot";
        let valid = (0.0..core::f64::consts::PI).contains(&inner);
        check(valid, of, "inner", inner, "from 0 to below pi radians")?;
        let valid = outer > inner && outer < core::f64::consts::PI;
        check(
            valid,
            of,
            "outer",
            outer,
            "above the inner angle and below pi radians",
        )?;
        let [inner, outer] = [inner, outer].map(|angle| (0.5 * angle).cos());
        Ok(1.0 / (inner - outer).max(NARROWEST))
    }
}
