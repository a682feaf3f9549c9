//! What the nodes of single scattering are told about camera, light and medium.

use bytemuck::{Pod, Zeroable};
use moment_shadows::{
    MapRegion, RectifiedFrame, RectifiedFrameError, RectifiedView, SingleScattering,
};

use super::shade_hard::parameters::{row, wide};
use super::{CameraView, LightDepth, LightView};

/// What a [`super::RectifyMoments`] node needs to know: the uniform struct of its shader.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct RectifyMomentsParameters {
    /// The rectified coordinates.
    pub frame: RectifiedFrame,
    /// Where the light ray through the camera meets the light's map, from 0 to 1 across the region.
    pub map_at_camera: [f32; 2],
    /// By how much that changes along the frame's first axis per scene unit.
    pub map_along_first: [f32; 2],
    /// The same along its second axis.
    pub map_along_second: [f32; 2],
    /// The light's moment depth at the camera.
    pub depth_at_camera: f32,
    /// By how much moment depth grows along the light per scene unit.
    pub depth_per_length: f32,
    /// Where the light's view lies in its map.
    pub region: MapRegion,
    /// The layer of the light's map.
    pub layer: u32,
    /// Unused; keeps the WGSL layout.
    pub padding: [u32; 3],
}

/// What an [`super::IntegrateScattering`] node needs to know: the uniform struct of its shader.
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

/// What a [`super::CompositeScattering`] node needs to know: the uniform struct of its shader.
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
    /// For `rectify_moments`.
    pub rectify: RectifyMomentsParameters,
    /// For `integrate_scattering`.
    pub integrate: IntegrateScatteringParameters,
    /// For `composite_scattering`.
    pub composite: CompositeScatteringParameters,
}

/// A camera or a light whose scattering cannot be prefiltered.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ScatteringViewError {
    /// The light's rays meet in a point.
    #[error(
        "the light is a point or spot light; only rays of a directional light are parallel to one axis of rectified coordinates: \
         give an orthographic light, or march the scattering of this one"
    )]
    PerspectiveLight,
    /// The light's matrix cannot be inverted.
    #[error(
        "the light's clip_from_world is singular or not finite; it has to be the invertible projection that its map was drawn \
         with"
    )]
    SingularLight,
    /// There are no rectified coordinates of this camera and light.
    #[error(transparent)]
    Frame(#[from] RectifiedFrameError),
}

impl ScatteringParameters {
    /// Of a perspective camera with surfaces and sky up to the distance `far` along its axis, a directional light and a medium.
    ///
    /// # Errors
    /// [`ScatteringViewError`], which names what is wrong.
    pub fn new(
        camera: &CameraView,
        far: f64,
        light: &LightView,
        medium: SingleScattering,
    ) -> Result<Self, ScatteringViewError> {
        let LightDepth::Orthographic { .. } = light.depth else {
            return Err(ScatteringViewError::PerspectiveLight);
        };
        let clip = wide(&light.clip_from_world);
        let [.., scale] = row(&clip, 3);
        if row(&clip, 3)[..3].iter().any(|&entry| entry != 0.0) {
            return Err(ScatteringViewError::PerspectiveLight);
        }
        let clip = clip.map(|column| column.map(|entry| entry / scale));
        let [x, y] = [0, 1].map(|axis| row(&clip, axis));
        let depth = light.depth.row(&clip);
        // Along the light the place in its map stays.
        let mut direction = cross(x, y);
        let grows = dot(depth, direction);
        direction = direction.map(|entry| entry * grows.signum());
        let finite = x
            .iter()
            .chain(&y)
            .chain(&depth)
            .all(|entry| entry.is_finite());
        if !(grows.abs() > 0.0 && grows.is_finite() && finite) {
            return Err(ScatteringViewError::SingularLight);
        }
        let RectifiedView {
            camera: at,
            axes,
            frame,
        } = RectifiedView::new(&camera.clip_from_world, far, direction)?;
        // u = (x + 1) / 2, v = (1 - y) / 2.
        let map = |[x, y]: [f64; 2]| [(0.5 * x) as f32, (-0.5 * y) as f32];
        let along = |axis: [f64; 3]| map([dot(x, axis), dot(y, axis)]);
        let [u, v] = map([dot(x, at) + x[3] + 1.0, dot(y, at) + y[3] - 1.0]);
        Ok(Self {
            rectify: RectifyMomentsParameters {
                frame,
                map_at_camera: [u, v],
                map_along_first: along(axes[0]),
                map_along_second: along(axes[1]),
                depth_at_camera: (dot(depth, at) + depth[3]) as f32,
                depth_per_length: dot(depth, axes[2]) as f32,
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

/// Of the linear part of a row and a direction or position.
fn dot(row: [f64; 4], vector: [f64; 3]) -> f64 {
    row[0] * vector[0] + row[1] * vector[1] + row[2] * vector[2]
}

fn cross(a: [f64; 4], b: [f64; 4]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}
