//! What materials are told: a row per camera, with the lights that it sees.

use bevy::math::{DMat4, DVec3, DVec4, Mat4};
use bytemuck::{Pod, Zeroable};
use moment_shadows::{AreaLight, DepthConversion, LeakReduction, LightView, ReceiverBias};

/// A view of a light: `ShadowView` of `shadow_view.wesl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct ShadowView {
    /// By columns: a position relative to the camera becomes the place in the map and its divisor, and moment depth.
    light_from_offset: [[f32; 4]; 4],
    receiver_bias: ReceiverBias,
    leak_reduction: LeakReduction,
    conversion: DepthConversion,
    light: AreaLight,
    /// The layer of the filtered map.
    layer: u32,
    /// The layer of Bevy's map.
    bevy_layer: u32,
    /// 0: no light. 1: a directional one. 2: a spot light.
    kind: u32,
    padding: u32,
}

/// The head of a camera's row: `ShadowCamera` of `shadow_view.wesl`. It is recognised by its matrix, since materials are bound once for
/// all cameras.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct ShadowCamera {
    clip_from_world: [[f32; 4]; 4],
    present: u32,
    padding: [u32; 3],
}

impl ShadowCamera {
    pub(crate) fn new(clip_from_world: Mat4) -> Self {
        Self {
            clip_from_world: clip_from_world.to_cols_array_2d(),
            present: 1,
            padding: [0; 3],
        }
    }
}

impl ShadowView {
    /// What a light's map needs to be looked up, from a camera at `eye`.
    pub(crate) fn new(
        light: &LightView,
        eye: DVec3,
        layer: u32,
        receiver_bias: ReceiverBias,
        leak_reduction: LeakReduction,
        area_light: AreaLight,
    ) -> Result<Self, moment_shadows::ValueError> {
        let clip = DMat4::from_cols_array_2d(&light.clip_from_world);
        let depth = light.depth.moment_depth_row(&light.clip_from_world);
        let [x, y, w] = [0, 1, 3].map(|index| clip.row(index));
        let depth = DVec4::from_array(depth.map(f64::from));
        let rows = [0.5 * (w + x), 0.5 * (w - y), w, depth];
        let rows = rows.map(|row| row.truncate().extend(row.dot(eye.extend(1.0))));
        let by_rows = DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]);
        let spot = w.truncate() != DVec3::ZERO;
        Ok(Self {
            light_from_offset: by_rows.transpose().as_mat4().to_cols_array_2d(),
            receiver_bias,
            leak_reduction,
            conversion: light.depth.conversion()?,
            light: area_light,
            layer,
            bevy_layer: light.layer,
            kind: 1 + u32::from(spot),
            padding: 0,
        })
    }
}
