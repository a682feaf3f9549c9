//! The parameters of `shade_hard`, from a camera and a light.

use moment_shadows::{
    AreaLight, DepthConversion, DepthError, DepthRange, LeakReduction, MapRegion, ReceiverBias,
};
use serde::{Deserialize, Serialize};

use super::ViewParameters;

/// A matrix by columns, in f64: products of f32 matrices with large translations keep their precision.
pub(in crate::nodes) type Matrix = [[f64; 4]; 4];

/// A camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CameraView {
    /// From scene to clip space, by columns; wgpu's clip space, with depth as the camera's texture stores it.
    pub clip_from_world: [[f32; 4]; 4],
    /// The stored depth of pixels that show no surface: 0 for reversed depth, 1 for forward depth.
    pub far_depth: f32,
}

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
    pub fn conversion(&self) -> Result<DepthConversion, DepthError> {
        match *self {
            LightDepth::Orthographic { reversed: false } => Ok(DepthConversion::orthographic()),
            LightDepth::Orthographic { reversed: true } => {
                Ok(DepthConversion::orthographic_reversed())
            }
            LightDepth::Perspective {
                near,
                far,
                reversed: false,
                range,
            } => DepthConversion::perspective(near, far, range),
            LightDepth::Perspective {
                near,
                far,
                reversed: true,
                range,
            } => DepthConversion::perspective_reversed(near, far, range),
        }
    }

    /// The linear function of a scene position (x, y, z, 1) that gives its moment depth, for the map's matrix.
    ///
    /// Moment depth is linear in the scene whatever the map stores, so a fragment's needs no stored depth.
    #[must_use]
    pub fn moment_depth_row(&self, clip_from_world: &[[f32; 4]; 4]) -> [f32; 4] {
        self.row(&wide(clip_from_world)).map(|value| value as f32)
    }

    pub(in crate::nodes) fn row(&self, clip_from_world: &Matrix) -> [f64; 4] {
        let (axis, factor, summand) = match *self {
            LightDepth::Orthographic { reversed } => {
                let sign = if reversed { -1.0 } else { 1.0 };
                (row(clip_from_world, 2), 2.0 * sign, -sign)
            }
            LightDepth::Perspective { range, .. } => {
                let extent = range.far - range.near;
                (
                    row(clip_from_world, 3),
                    2.0 / extent,
                    -(range.near + range.far) / extent,
                )
            }
        };
        let mut scaled = axis.map(|value| value * factor);
        scaled[3] += summand;
        scaled
    }
}

/// A camera or a light that no parameters can be made for.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ViewError {
    /// A matrix cannot be inverted.
    #[error(
        "the camera's clip_from_world is singular or not finite; it has to be an invertible projection of the scene"
    )]
    SingularCamera,
    /// The same of the light.
    #[error(
        "the light's clip_from_world is singular or not finite; it has to be the invertible projection that its map was drawn \
         with"
    )]
    SingularLight,
    /// The light's planes or range of depth are no such.
    #[error(transparent)]
    Depth(#[from] DepthError),
}

impl ViewParameters {
    /// The parameters of a camera that looks at receivers of a light's shadow.
    ///
    /// The matrices are combined in f64. [`ReceiverBias::for_kernel`] gives a bias that follows from the map's filter.
    pub fn new(
        camera: &CameraView,
        light: &LightView,
        receiver_bias: ReceiverBias,
        leak_reduction: LeakReduction,
    ) -> Result<Self, ViewError> {
        let world_from_clip =
            invert(&wide(&camera.clip_from_world)).ok_or(ViewError::SingularCamera)?;
        let light_clip = wide(&light.clip_from_world);
        invert(&light_clip).ok_or(ViewError::SingularLight)?;
        let conversion = light.depth.conversion()?;
        let (x, y, w) = (
            row(&light_clip, 0),
            row(&light_clip, 1),
            row(&light_clip, 3),
        );
        // From clip space to the map: u = (x + w) / 2, v = (w - y) / 2, both still times w.
        let half_sum = |a: [f64; 4], b: [f64; 4], sign: f64| {
            [0, 1, 2, 3].map(|index| 0.5 * (b[index] + sign * a[index]))
        };
        let rows = [
            half_sum(x, w, 1.0),
            half_sum(y, w, -1.0),
            w,
            light.depth.row(&light_clip),
        ];
        let combined = rows.map(|row| multiply_row(&row, &world_from_clip));
        let mut light_from_camera = [[0.0; 4]; 4];
        for (column, values) in light_from_camera.iter_mut().enumerate() {
            *values = combined.map(|row| row[column] as f32);
        }
        Ok(Self {
            light_from_camera,
            scene_w_from_camera: row(&world_from_clip, 3).map(|value| value as f32),
            receiver_bias,
            leak_reduction,
            region: light.region,
            far_depth: camera.far_depth,
            layer: light.layer,
            channel: light.channel,
            padding: 0.0,
            conversion,
            light: AreaLight::NONE,
        })
    }
}

pub(in crate::nodes) fn wide(matrix: &[[f32; 4]; 4]) -> Matrix {
    matrix.map(|column| column.map(f64::from))
}

pub(in crate::nodes) fn row(matrix: &Matrix, index: usize) -> [f64; 4] {
    [0, 1, 2, 3].map(|column| matrix[column][index])
}

fn multiply_row(row: &[f64; 4], matrix: &Matrix) -> [f64; 4] {
    [0, 1, 2, 3].map(|column| (0..4).map(|index| row[index] * matrix[column][index]).sum())
}

fn invert(matrix: &Matrix) -> Option<Matrix> {
    let inverse = glam::DMat4::from_cols_array_2d(matrix).inverse();
    inverse.is_finite().then(|| inverse.to_cols_array_2d())
}
