//! Host-side mathematics: cameras, views of lights, and the uniform structs that are made of them.
//!
//! Matrices are plain arrays of f64 by columns outside, glam's inside: products of f32 matrices with large translations lose
//! digits, and shadows then move by texels. A host whose matrices are f32 makes them relative to its camera.

mod camera;
mod light;
mod parameters;
mod rectified;
mod scattering;

pub use camera::CameraView;
use glam::{DMat4, DVec4};
pub use light::{LightDepth, LightSize, LightView};
pub use parameters::ViewParameters;
pub use rectified::{RectifiedFrame, RectifiedView};
pub use scattering::{
    CompositeScatteringParameters, IntegrateScatteringParameters, RectifyMomentsParameters,
    ScatteringParameters,
};

use crate::ValueError;

fn singular_camera() -> ValueError {
    let message = "the camera's clip_from_world is singular or not finite; it has to be an invertible projection of the scene";
    ValueError::new("camera", message)
}

fn singular_light() -> ValueError {
    let message = "the light's clip_from_world is singular or not finite; it has to be the invertible projection that its map \
                   was drawn with";
    ValueError::new("light", message)
}

/// The largest difference between the identity and the product of a matrix and its inverse: beyond it the inverse is rounding
/// error.
const LARGEST_RESIDUAL: f64 = 1e-6;

/// The inverse; `None` if the matrix has none, or if entries are not finite.
fn inverse(matrix: DMat4) -> Option<DMat4> {
    // Rows of very different size, as projections have them, are scaled to a largest entry of 1.
    let rows = matrix.transpose();
    let scales = [0, 1, 2, 3].map(|index| rows.col(index).abs().max_element());
    if scales.iter().any(|&scale| scale <= 0.0) || !matrix.is_finite() {
        return None;
    }
    let scale = DMat4::from_diagonal(DVec4::from_array(scales).recip());
    let scaled = scale * matrix;
    let inverse = scaled.inverse();
    let residual = inverse * scaled - DMat4::IDENTITY;
    let largest = residual
        .to_cols_array()
        .into_iter()
        .fold(0.0, |largest: f64, entry| largest.max(entry.abs()));
    let unscaled = inverse * scale;
    (unscaled.is_finite() && residual.is_finite() && largest <= LARGEST_RESIDUAL)
        .then_some(unscaled)
}
