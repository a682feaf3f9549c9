//! The parameters of nodes that shade a picture, from a camera and a light.

use bytemuck::{Pod, Zeroable};
use glam::{DMat4, DVec3, DVec4};

use super::tile::PLACE_ERROR;
use super::{CameraView, LightView, inverse};
use crate::value_error::check;
use crate::{AreaLight, DepthConversion, LeakReduction, MapRegion, ReceiverBias, ValueError};

/// What nodes that shade a picture need to know of a view of a light: the uniform struct of their shader.
///
/// Made by [`ViewParameters::new`] from a camera and a light.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct ViewParameters {
    /// From the camera's clip space to the light, by columns.
    pub light_from_camera: [[f32; 4]; 4],
    /// The homogeneous coordinate of the scene position.
    pub scene_w_from_camera: [f32; 4],
    /// By rows, the scene position relative to the camera, times that coordinate: for normals.
    pub position_from_camera: [[f32; 4]; 3],
    /// How far fragments move towards the light.
    pub receiver_bias: ReceiverBias,
    /// The reduction of light leaking after the bound.
    pub leak_reduction: LeakReduction,
    /// Where the view lies in its layer; [`MapRegion::NONE`] if there is no such view.
    pub region: MapRegion,
    /// The stored depth of pixels that show no surface: 0 for reversed depth. The first view's counts for all.
    pub far_depth: f32,
    /// The map's layer.
    pub layer: u32,
    /// The light's channel in the outputs, 0 to 15, of which the first view that contains a pixel shades it. Nodes with borders read
    /// the rest: 16 where shadows fade out along the border, 32 where that is a circle, and in the upper half its width in
    /// sixteenths of a texel.
    pub channel: u32,
    /// Texels along the region's edges in which no place is looked up.
    pub guard: f32,
    /// How the light's map stores depth: for techniques that read the plain depth map.
    pub conversion: DepthConversion,
    /// The light's size: for percentage-closer soft shadows.
    pub light: AreaLight,
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
    ) -> Result<Self, ValueError> {
        let camera_clip = DMat4::from_cols_array_2d(&camera.clip_from_world);
        let world_from_clip = inverse(camera_clip, "camera")?;
        let light_clip = DMat4::from_cols_array_2d(&light.clip_from_world);
        inverse(light_clip, "light")?;
        let conversion = light.depth.conversion()?;
        light.depth.check_matrix(light_clip)?;
        light.check_border(light.region.extent)?;
        let channel = light.channel;
        check(channel < 16, "a light", "channel", channel, "0 to 15")?;
        let [x, y, w] = [0, 1, 3].map(|index| light_clip.row(index));
        // From clip space to the map: u = (x + w) / 2, v = (w - y) / 2, both still times w.
        let rows = [0.5 * (w + x), 0.5 * (w - y), w, light.depth.row(light_clip)];
        let light_from_world =
            DMat4::from_cols_array_2d(&rows.map(|row| row.to_array())).transpose();
        let position = position_rows(world_from_clip);
        Ok(Self {
            light_from_camera: (light_from_world * world_from_clip)
                .as_mat4()
                .to_cols_array_2d(),
            scene_w_from_camera: world_from_clip.row(3).as_vec4().to_array(),
            position_from_camera: position.map(|row| row.as_vec4().to_array()),
            receiver_bias,
            leak_reduction,
            region: light.region,
            far_depth: camera.far_depth,
            layer: light.layer,
            channel: channel | light.border.word(),
            guard: (f64::from(light.guard) - PLACE_ERROR).max(0.0) as f32,
            conversion,
            light: AreaLight::NONE,
        })
    }
}

/// What positions are relative to: rays of a perspective camera meet in what depth alone leads to, those of another begin at its near
/// plane.
pub(super) fn eye_of(world_from_clip: DMat4) -> DVec3 {
    let eye = match world_from_clip.z_axis {
        meeting if meeting.w != 0.0 => meeting,
        _ => world_from_clip.w_axis,
    };
    eye.truncate() / eye.w
}

/// The rows that give a scene position relative to the camera, times its homogeneous coordinate, of clip coordinates.
pub(super) fn position_rows(world_from_clip: DMat4) -> [DVec4; 3] {
    let (eye, scene_w) = (eye_of(world_from_clip), world_from_clip.row(3));
    [0, 1, 2].map(|axis| world_from_clip.row(axis) - eye[axis] * scene_w)
}
