//! The parameters of the nodes of single scattering: camera, light and medium.

use bytemuck::{Pod, Zeroable};
use glam::{DMat4, DVec3, DVec4};

use super::{CameraView, LightDepth, LightView, RectifiedFrame, RectifiedView, singular};
use crate::{MapRegion, SingleScattering, ValueError};

/// The parameters of a `rectify_moments` node: the uniform struct of its shader.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct RectifyMomentsParameters {
    /// The rectified coordinates.
    pub frame: RectifiedFrame,
    /// Where the light ray through the camera meets the light's map, from 0 to 1 across the region.
    pub map_at_camera: [f32; 2],
    /// The change of that place along the frame's first axis per scene unit.
    pub map_along_first: [f32; 2],
    /// The change of that place along the frame's second axis per scene unit.
    pub map_along_second: [f32; 2],
    /// The light's moment depth at the camera.
    pub depth_at_camera: f32,
    /// The growth of moment depth along the light per scene unit.
    pub depth_per_length: f32,
    /// Where the light's view lies in its map.
    pub region: MapRegion,
    /// The layer of the light's map.
    pub layer: u32,
    /// Unused; keeps the WGSL layout.
    pub padding: [u32; 3],
}

/// The parameters of an `integrate_scattering` node: the uniform struct of its shader.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct IntegrateScatteringParameters {
    /// The rectified coordinates.
    pub frame: RectifiedFrame,
    /// The extinction that columns are weighted with, per scene unit.
    pub extinction: f32,
    /// Unused; keeps the WGSL layout.
    pub padding: [f32; 3],
}

/// The parameters of a `composite_scattering` node: the uniform struct of its shader.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct CompositeScatteringParameters {
    /// The rectified coordinates.
    pub frame: RectifiedFrame,
    /// The medium.
    pub medium: SingleScattering,
}

/// The parameters of the three nodes of single scattering, for one camera, light and medium.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScatteringParameters {
    /// The parameters of `rectify_moments`.
    pub rectify: RectifyMomentsParameters,
    /// The parameters of `integrate_scattering`.
    pub integrate: IntegrateScatteringParameters,
    /// The parameters of `composite_scattering`.
    pub composite: CompositeScatteringParameters,
}

impl ScatteringParameters {
    /// The parameters for a perspective camera with surfaces and sky up to the distance `far` along its axis, a directional
    /// light and a medium.
    ///
    /// # Errors
    /// [`ValueError`], which names what is wrong.
    pub fn new(
        camera: &CameraView,
        far: f64,
        light: &LightView,
        medium: SingleScattering,
    ) -> Result<Self, ValueError> {
        let clip = DMat4::from_cols_array_2d(&light.clip_from_world);
        let last = clip.row(3);
        let parallel = matches!(light.depth, LightDepth::Orthographic { .. });
        if !parallel || last.truncate() != DVec3::ZERO {
            let message = "the light is a point or spot light; only rays of a directional light are parallel to one axis of rectified \
                           coordinates: give an orthographic light, or march the scattering of this one";
            return Err(ValueError::new("light", message));
        }
        let clip = clip * (1.0 / last.w);
        let (x, y, depth) = (clip.row(0), clip.row(1), light.depth.row(clip));
        // Along the light the place in its map stays.
        let across = x.truncate().cross(y.truncate());
        let grows = depth.truncate().dot(across);
        let finite = x.is_finite() && y.is_finite() && depth.is_finite();
        if !(grows.abs() > 0.0 && grows.is_finite() && finite) {
            return Err(singular("light"));
        }
        let direction = across * grows.signum();
        let RectifiedView {
            camera: at,
            axes,
            frame,
        } = RectifiedView::new(&camera.clip_from_world, far, direction.to_array())?;
        let at = DVec3::from(at).extend(1.0);
        let axes = axes.map(|axis| DVec3::from(axis).extend(0.0));
        // u = (x + 1) / 2, v = (1 - y) / 2.
        let map = |x: f64, y: f64| [(0.5 * x) as f32, (-0.5 * y) as f32];
        let along = |axis: DVec4| map(x.dot(axis), y.dot(axis));
        Ok(Self {
            rectify: RectifyMomentsParameters {
                frame,
                map_at_camera: map(x.dot(at) + 1.0, y.dot(at) - 1.0),
                map_along_first: along(axes[0]),
                map_along_second: along(axes[1]),
                depth_at_camera: depth.dot(at) as f32,
                depth_per_length: depth.dot(axes[2]) as f32,
                region: light.region,
                layer: light.layer,
                padding: [0; 3],
            },
            integrate: IntegrateScatteringParameters {
                frame,
                extinction: medium.mean_extinction,
                padding: [0.0; 3],
            },
            composite: CompositeScatteringParameters { frame, medium },
        })
    }
}
