//! The parameters of shadows at contacts, from a camera and a light.

use bytemuck::{Pod, Zeroable};
use glam::{DMat4, DVec3, DVec4};

use super::parameters::{eye_of, position_rows};
use super::{CameraView, LightDepth, LightView, inverse};
use crate::ValueError;
use crate::value_error::check;

/// No march is longer: products of it and of directions stay finite.
const LONGEST: f64 = 1e18;

/// How far shadows at contacts reach, in scene units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactShadows {
    /// How far a surface looks for what stands between it and the light; over the last quarter shadows fade out. Maps serve farther
    /// away, so that some texels of the light's map are enough.
    pub length: f64,
    /// How thick surfaces are whose backs the camera does not see: what passes behind them at a larger distance is lit.
    pub thickness: f64,
}

impl Default for ContactShadows {
    /// For scenes in metres: a length of 6 cm, and surfaces of 2 cm.
    fn default() -> Self {
        Self {
            length: 0.06,
            thickness: 0.02,
        }
    }
}

/// What shadows at contacts need to know of a light: the uniform struct of the WGSL module `contact_shadow`.
///
/// Made by [`ContactShadowParameters::new`] from a camera and a light.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct ContactShadowParameters {
    /// With parallel rays, the change of the camera's clip coordinates per scene unit towards the light; else the light's clip coordinates.
    pub light_clip: [f32; 4],
    /// The light's position relative to the camera, and 1; zeros with parallel rays.
    pub light_position: [f32; 4],
    /// By rows, the scene position relative to the camera, times its homogeneous coordinate.
    pub position_from_camera: [[f32; 4]; 3],
    /// The homogeneous coordinate of the scene position.
    pub scene_w_from_camera: [f32; 4],
    /// The difference of two distances along the camera's axis, times both homogeneous coordinates, per that of their stored depths.
    pub depth_scale: f32,
    /// How far rays go; 0 where there is no light.
    pub length: f32,
    /// How thick surfaces are.
    pub thickness: f32,
    /// The stored depth of pixels that show no surface: 0 for reversed depth. The first light's counts for all.
    pub far_depth: f32,
}

impl ContactShadows {
    /// Checks that both are lengths.
    ///
    /// # Errors
    /// [`ValueError`] about the `length` or the `thickness`.
    pub fn check(&self) -> Result<(), ValueError> {
        for (name, value) in [("length", self.length), ("thickness", self.thickness)] {
            let valid = value > 0.0 && (value as f32).is_normal() && value <= LONGEST;
            let range = "above 0, at most 1e18, and normal in single precision";
            check(valid, "shadows at contacts", name, value, range)?;
        }
        Ok(())
    }
}

impl ContactShadowParameters {
    /// The parameters of a camera that looks at receivers of a light's shadow. Of a light with several views, any of them says where it is.
    ///
    /// Everything is combined in f64, and holds no large scene coordinates.
    ///
    /// # Errors
    /// [`ValueError`] about the `camera`, the `light`, its `depth`, the `length` or the `thickness`.
    pub fn new(
        camera: &CameraView,
        light: &LightView,
        contact: ContactShadows,
    ) -> Result<Self, ValueError> {
        contact.check()?;
        let clip = DMat4::from_cols_array_2d(&camera.clip_from_world);
        let world_from_clip = inverse(clip, "camera")?;
        let light_clip = DMat4::from_cols_array_2d(&light.clip_from_world);
        let along_depth = inverse(light_clip, "light")?.z_axis;
        light.depth.check_matrix(light_clip)?;
        let eye = eye_of(world_from_clip);
        let (light_clip, light_position) = match light.depth {
            LightDepth::Orthographic { .. } => {
                let away = along_depth.truncate() * light.depth.row(light_clip).dot(along_depth);
                let towards = (-away.normalize_or_zero()).extend(0.0);
                (clip * towards, DVec4::ZERO)
            }
            // Its rays meet in what depth alone leads to.
            LightDepth::Perspective { .. } | LightDepth::Linear { .. } => {
                let position = along_depth / along_depth.w;
                let relative = position.truncate() - eye;
                (clip * position, relative.extend(1.0))
            }
        };
        let scene_w = world_from_clip.row(3);
        let position = position_rows(world_from_clip);
        let axis = axis(clip, camera.far_depth);
        let [x, y, z] = position;
        let distance = axis.x * x + axis.y * y + axis.z * z;
        let depth_scale = distance.z * scene_w.w - distance.w * scene_w.z;
        let single = |vector: DVec4| vector.as_vec4().to_array();
        Ok(Self {
            light_clip: single(light_clip),
            light_position: single(light_position),
            position_from_camera: position.map(single),
            scene_w_from_camera: single(scene_w),
            depth_scale: depth_scale as f32,
            length: contact.length as f32,
            thickness: contact.thickness as f32,
            far_depth: camera.far_depth,
        })
    }

    /// The parameters in place of a light that there is not, for the same camera.
    #[must_use]
    pub fn without_light(self) -> Self {
        Self {
            length: 0.0,
            ..self
        }
    }
}

/// Where the camera looks, with length 1.
fn axis(clip: DMat4, far_depth: f32) -> DVec3 {
    let last = clip.row(3);
    let axis = last.truncate();
    if axis != DVec3::ZERO {
        return axis.normalize_or_zero();
    }
    // Parallel view rays: depth grows, or falls where it is reversed.
    let sign = if far_depth < 0.5 { -last.w } else { last.w };
    (clip.row(2).truncate() * sign).normalize_or_zero()
}
