//! The camera, the light, the medium and the light's map that the nodes are timed and checked with.

use core::f64::consts::TAU;

use glam::{DMat4, DVec3, DVec4};
use half::f16;
use moment_shadows::{
    CameraView, LightView, RectifiedView, ScatteringParameters, SingleScattering, Storage,
};

use super::super::reference::channels;
use crate::error::LabError;
use crate::view::Camera;

/// Extinction per scene unit: a view ray to the far end is one and a half optical thicknesses long.
const EXTINCTION: f32 = 0.075;

/// Up to where light is scattered.
const FAR: f64 = 20.0;

/// Everything that does not depend on the size of a map.
pub(super) struct ScatteringView {
    /// From scene to the light's clip space.
    pub light: DMat4,
    /// The rectified coordinates, in f64 where that matters.
    pub rectified: RectifiedView,
    /// What the nodes are told.
    pub parameters: ScatteringParameters,
}

impl ScatteringView {
    /// A camera that looks across the light, amidst what the light's map sees.
    pub(super) fn new() -> Result<Self, LabError> {
        let direction = DVec3::new(0.5, -1.0, 0.3).normalize();
        let eye = DVec3::new(0.4, 1.7, 0.3);
        let across = direction.any_orthonormal_vector();
        let camera = Camera {
            eye,
            target: eye + across + 0.2 * direction,
            vertical_angle: 1.1,
            aspect: 1.5,
            near: 0.1,
            far: None,
        };
        let camera = camera.clip_from_world_columns()?;
        let light = light(direction);
        let extinction = [EXTINCTION; 3];
        let medium = SingleScattering::new(extinction, extinction, 0.0, [1.0; 3])?;
        let parameters = ScatteringParameters::new(
            &CameraView {
                clip_from_world: camera,
                far_depth: 0.0,
            },
            FAR,
            &LightView::orthographic(light.to_cols_array_2d()),
            medium,
        )?;
        Ok(Self {
            light,
            rectified: RectifiedView::new(&camera, FAR, direction.to_array())
                .map_err(|error| LabError::unsuitable("the view of the scattering nodes", error))?,
            parameters,
        })
    }
}

/// A light whose map is 80 units wide and deep, about the origin.
fn light(direction: DVec3) -> DMat4 {
    let first = direction.any_orthonormal_vector();
    let second = direction.cross(first);
    let column = |axis: usize| {
        let across = [first[axis], second[axis], 0.5 * direction[axis]];
        (DVec3::from_array(across) / 40.0).extend(0.0)
    };
    let origin = DVec4::new(0.0, 0.0, 0.5, 1.0);
    DMat4::from_cols(column(0), column(1), column(2), origin)
}

/// Float16 channels of a light's map of two surfaces in each texel, which change slowly across it: their depths stay far
/// apart and both well covered, so that both are as sharp as the channels.
pub(super) fn two_surfaces(size: u32) -> Vec<u8> {
    let wave = |place: f64| (TAU * place).sin();
    (0..size * size)
        .flat_map(|index| {
            let [u, v] = [index % size, index / size]
                .map(|place| (f64::from(place) + 0.5) / f64::from(size));
            let near = -0.5 + 0.2 * wave(2.0 * u + v);
            let far = 0.3 + 0.2 * wave(2.0 * v - u);
            let share = 0.5 + 0.3 * wave(u + v);
            let moments = [1, 2, 3, 4]
                .map(|power| share * near.powi(power) + (1.0 - share) * far.powi(power));
            channels(moments, Storage::Float16).map(|channel| f16::from_f64(channel).to_le_bytes())
        })
        .flatten()
        .collect()
}
