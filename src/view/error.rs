//! Cameras and lights for which no parameters can be made.

use crate::DepthError;

/// A camera or a light for which no parameters can be made.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ViewError {
    /// The camera's matrix cannot be inverted.
    #[error(
        "the camera's clip_from_world is singular or not finite; it has to be an invertible projection of the scene"
    )]
    SingularCamera,
    /// The light's matrix cannot be inverted.
    #[error(
        "the light's clip_from_world is singular or not finite; it has to be the invertible projection that its map was drawn \
         with"
    )]
    SingularLight,
    /// The light's planes or its range of depth are invalid.
    #[error(transparent)]
    Depth(#[from] DepthError),
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
    /// This camera and light have no rectified coordinates.
    #[error(transparent)]
    Frame(#[from] RectifiedFrameError),
}

/// A camera or a light that has no rectified coordinates.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RectifiedFrameError {
    /// The camera's matrix cannot be inverted.
    #[error(
        "the camera's clip_from_world is singular or not finite; it has to be an invertible projection of the scene"
    )]
    SingularCamera,
    /// The camera's view rays are parallel.
    #[error(
        "the camera is orthographic; rectified coordinates need view rays that meet in the camera: use a perspective camera, \
         or march the scattering"
    )]
    OrthographicCamera,
    /// The frustum has no length.
    #[error(
        "the far distance is {far}, but must be above 0 and finite: how far along the camera's axis light is scattered"
    )]
    FarDistance {
        /// The distance that was given.
        far: f64,
    },
    /// The light has no direction.
    #[error(
        "the light's direction is ({}, {}, {}), but must be finite and not zero: where light travels to",
        direction[0], direction[1], direction[2]
    )]
    LightDirection {
        /// The direction that was given.
        direction: [f64; 3],
    },
    /// A number of the frame does not fit into single precision.
    #[error("the frustum's size is beyond single precision; choose another unit of length")]
    Size,
}
