//! Host-side mathematics: cameras, views of lights, what they have to see, and the uniform structs that are made of them.
//!
//! Matrices are plain arrays of f64 by columns outside, glam's inside: products of f32 matrices with large translations lose
//! digits, and shadows then move by texels. A host whose matrices are f32 makes them relative to its camera.

mod atlas;
mod border;
mod camera;
mod cascade_splits;
mod cascades;
mod contact_shadow;
mod frustum;
mod height_fog;
mod light;
mod march;
mod parameters;
mod point_light;
mod punctual_light;
mod rectified;
mod scattering;
mod tile;

pub use atlas::Atlas;
pub use border::Border;
pub use camera::CameraView;
pub use cascade_splits::CascadeSplits;
pub use cascades::Cascades;
pub use contact_shadow::{ContactShadowParameters, ContactShadows};
use glam::{DMat4, DVec3, DVec4};
pub use height_fog::{HeightFog, HeightFogView};
pub use light::{LightDepth, LightView};
pub use march::{MarchScatteringParameters, MarchedAir, UpsampleScatteringParameters};
pub use parameters::ViewParameters;
pub use point_light::PointLight;
pub use punctual_light::{PunctualLight, SpotCone};
pub use rectified::{RectifiedFrame, RectifiedView};
pub use scattering::{
    CompositeScatteringParameters, IntegrateScatteringParameters, RectifyMomentsParameters,
    ScatteringParameters,
};
pub use tile::Tile;

use crate::ValueError;

/// Where light travels to, with length 1.
fn light_direction(direction: [f64; 3]) -> Result<DVec3, ValueError> {
    let direction = DVec3::from(direction);
    rectified::normalized(direction).ok_or_else(|| {
        let message = format!(
            "the light's direction is {direction}, but must be finite and not zero: where light travels to"
        );
        ValueError::new("light_direction", message)
    })
}

/// The refusal of the matrix of a `camera` or a `light`.
fn singular(name: &'static str) -> ValueError {
    let message = format!(
        "the {name}'s clip_from_world is singular or not finite; it has to be the invertible projection that its picture was drawn with"
    );
    ValueError::new(name, message)
}

/// The largest difference between the identity and the product of a matrix and its inverse: beyond it the inverse is rounding
/// error.
const LARGEST_RESIDUAL: f64 = 1e-6;

/// The inverse of the matrix of a `camera` or a `light`; an error if there is none, or if entries are not finite.
fn inverse(matrix: DMat4, name: &'static str) -> Result<DMat4, ValueError> {
    // Rows of very different size, as projections have them, are scaled to a largest entry of 1.
    let rows = matrix.transpose();
    let scales = [0, 1, 2, 3].map(|index| rows.col(index).abs().max_element());
    let scale = DMat4::from_diagonal(DVec4::from_array(scales).recip());
    let scaled = scale * matrix;
    let inverse = scaled.inverse();
    let residual = (inverse * scaled - DMat4::IDENTITY).to_cols_array();
    // False for a residual that is NaN, as it is of a matrix with a row of zeros.
    let is_small = |entry: f64| entry.abs() <= LARGEST_RESIDUAL;
    let unscaled = inverse * scale;
    if unscaled.is_finite() && residual.into_iter().all(is_small) {
        Ok(unscaled)
    } else {
        Err(singular(name))
    }
}
