//! The parameters of the nodes that march scattered light: camera, light and air.

use bytemuck::{Pod, Zeroable};
use glam::{DMat4, DVec3, DVec4};

use super::parameters::{eye_of, position_rows};
use super::tile::PLACE_ERROR;
use super::{CameraView, HeightFog, HeightFogView, LightView, PunctualLight, SpotCone, inverse};
use crate::value_error::check;
use crate::{DepthConversion, LeakReduction, MapRegion, SingleScattering, ValueError};

/// What is in the air beside its medium, for nodes that march.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarchedAir {
    /// How the medium thins with height.
    pub fog: HeightFog,
    /// The cone of the light, where that is a spot.
    pub cone: Option<SpotCone>,
    /// The number of the frame, from which on dithered steps turn. The same number gives the same picture.
    pub frame: u32,
    /// Four numbers for a density of the host's own.
    pub own: [f32; 4],
}

impl Default for MarchedAir {
    fn default() -> Self {
        Self {
            fog: HeightFog::NONE,
            cone: None,
            frame: 0,
            own: [0.0; 4],
        }
    }
}

/// The parameters of a `march_scattering` node for a view of its light: the uniform struct of its shader.
///
/// Made by [`MarchScatteringParameters::new`]. What is not of the view is the same for all, and the first one's counts.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct MarchScatteringParameters {
    /// By rows, the scene position relative to the camera, times its homogeneous coordinate.
    pub position_from_camera: [[f32; 4]; 3],
    /// The homogeneous coordinate of the scene position.
    pub scene_w_from_camera: [f32; 4],
    /// The medium, and the light's irradiance: at distance 1 from a light with a position.
    pub medium: SingleScattering,
    /// How its density differs from place to place.
    pub fog: HeightFogView,
    /// The light.
    pub light: PunctualLight,
    /// From positions relative to the camera to the view's map, by columns.
    pub map_from_position: [[f32; 4]; 4],
    /// The reduction of light leaking after the bound.
    pub leak_reduction: LeakReduction,
    /// How the light's map stores depth: for techniques that read the plain depth map.
    pub conversion: DepthConversion,
    /// Where the view lies in its layer; [`MapRegion::NONE`] if there is no such view.
    pub region: MapRegion,
    /// The camera in the scene: for a density of the host's own.
    pub eye: [f32; 3],
    /// The scene's homogeneous coordinate at the far end.
    pub farthest_w: f32,
    /// Four numbers for a density of the host's own.
    pub own: [f32; 4],
    /// By how much dithered steps are shifted in this frame, as a part of one.
    pub offset: f32,
    /// Texels along the region's edges in which no place is looked up.
    pub guard: f32,
    /// The map's layer.
    pub layer: u32,
    /// Unused; keeps the WGSL layout.
    pub padding: u32,
}

/// What steps turn by from frame to frame: the smaller part of the golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

impl MarchScatteringParameters {
    /// The parameters for a perspective camera with surfaces and sky up to the distance `far` along its axis, a view of a light, and
    /// what is in the air. The medium's irradiance is that of a surface that faces the light, of one with a position at distance 1; it is
    /// dimmed by what is in the air on its way, a sun's is not.
    ///
    /// # Errors
    /// [`ValueError`], which names what is wrong.
    pub fn new(
        camera: &CameraView,
        far: f64,
        light: &LightView,
        medium: SingleScattering,
        air: &MarchedAir,
        leak_reduction: LeakReduction,
    ) -> Result<Self, ValueError> {
        let rays = Rays::new(camera, far)?;
        let clip = DMat4::from_cols_array_2d(&light.clip_from_world);
        let punctual = PunctualLight::new(light, air.cone, rays.eye.to_array(), far)?;
        light.check_border(light.region.extent)?;
        let [x, y, w] = [0, 1, 3].map(|index| clip.row(index));
        // u = (x + w) / 2, v = (w - y) / 2, both still times w.
        let rows = [0.5 * (w + x), 0.5 * (w - y), w, light.depth.row(clip)];
        let from_world = DMat4::from_cols_array_2d(&rows.map(|row| row.to_array())).transpose();
        let from_position = from_world * DMat4::from_translation(rays.eye);
        Ok(Self {
            position_from_camera: rays.position.map(|row| row.as_vec4().to_array()),
            scene_w_from_camera: rays.scene_w.as_vec4().to_array(),
            medium,
            fog: air.fog.view(rays.eye.to_array())?,
            light: punctual,
            map_from_position: from_position.as_mat4().to_cols_array_2d(),
            leak_reduction,
            conversion: light.depth.conversion()?,
            region: light.region,
            eye: rays.eye.as_vec3().to_array(),
            farthest_w: rays.farthest_w,
            own: air.own,
            offset: (f64::from(air.frame) * GOLDEN).fract() as f32,
            guard: (f64::from(light.guard) - PLACE_ERROR).max(0.0) as f32,
            layer: light.layer,
            padding: 0,
        })
    }
}

/// The parameters of an `upsample_scattering` node: the uniform struct of its shader.
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct UpsampleScatteringParameters {
    /// The homogeneous coordinate of the scene position.
    pub scene_w_from_camera: [f32; 4],
    /// Its value at the far end.
    pub farthest_w: f32,
    /// Unused; keeps the WGSL layout.
    pub padding: [f32; 3],
}

impl UpsampleScatteringParameters {
    /// The parameters for a perspective camera with surfaces and sky up to the distance `far` along its axis.
    ///
    /// # Errors
    /// [`ValueError`], which names what is wrong.
    pub fn new(camera: &CameraView, far: f64) -> Result<Self, ValueError> {
        let rays = Rays::new(camera, far)?;
        Ok(Self {
            scene_w_from_camera: rays.scene_w.as_vec4().to_array(),
            farthest_w: rays.farthest_w,
            padding: [0.0; 3],
        })
    }
}

/// The view rays of a perspective camera.
struct Rays {
    eye: DVec3,
    position: [DVec4; 3],
    scene_w: DVec4,
    farthest_w: f32,
}

impl Rays {
    fn new(camera: &CameraView, far: f64) -> Result<Self, ValueError> {
        let clip = DMat4::from_cols_array_2d(&camera.clip_from_world);
        let world_from_clip = inverse(clip, "camera")?;
        let of = "the far end of scattering";
        let range = "above 0 and at most 1e9: how far along the camera's axis light is scattered";
        check(far > 0.0 && far <= LONGEST, of, "far", far, range)?;
        let meeting = world_from_clip.z_axis;
        if meeting.w.abs() <= 1e-12 * meeting.truncate().length() {
            let message = "the camera is orthographic; scattered light is marched along view rays that meet in the camera: use a \
                           perspective camera";
            return Err(ValueError::new("camera", message));
        }
        let position = position_rows(world_from_clip);
        let scene_w = world_from_clip.row(3);
        // Along x, y and from the middle; depth has no part in a direction.
        let along = [0, 1, 3].map(|column: usize| {
            DVec3::new(
                position[0][column],
                position[1][column],
                position[2][column],
            )
        });
        let normal = along[0].cross(along[1]).normalize_or_zero();
        let farthest_w = (normal.dot(along[2]).abs() / far) as f32;
        let numbers = position.into_iter().chain([scene_w]);
        let are_finite = numbers.into_iter().all(|row| row.as_vec4().is_finite());
        if !(farthest_w.is_normal() && are_finite) {
            let message =
                "the frustum's size is beyond single precision; choose another unit of length";
            return Err(ValueError::new("frustum", message));
        }
        Ok(Self {
            eye: eye_of(world_from_clip),
            position,
            scene_w,
            farthest_w,
        })
    }
}

/// The largest distance that the shader has.
const LONGEST: f64 = 1e9;
