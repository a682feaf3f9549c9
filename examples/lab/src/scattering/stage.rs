//! A scene with something in its air, drawn, with the truth of what the camera sees of it.

use bytemuck::{Pod, Zeroable, bytes_of};
use glam::DVec3;
use moment_shadows::{Kernel, RectifiedFrame, ScatteringParameters, SingleScattering};
use wgpu::util::DeviceExt;

use super::air::Air;
use super::look::LookDesc;
use super::truth::{MarchedRays, Rays, marched, marched_filtered};
use crate::error::LabError;
use crate::frame::{Frame, FrameDesc};
use crate::gpu::Gpu;
use crate::graph_frame::scattering_parameters;
use crate::host::{Surface, read_depth_samples, read_gbuffer};
use crate::light::LightShape;
use crate::scene::Scene;
use crate::truth::kernel::TapPattern;

/// Samples per texel of the map, for techniques that can have several.
const SAMPLES: u32 = 4;

/// Texels that the map leaves free around the casters beyond the blur's radius.
const MARGIN: f64 = 2.0;

/// How far behind the scene's middle the air ends, in parts of its radius.
const BEHIND: f64 = 1.5;

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScatteringStageDesc {
    /// The viewpoint.
    pub look: LookDesc,
    /// Optical thickness between the camera and the far end.
    pub thickness: f64,
    /// Of the phase function.
    pub anisotropy: f32,
    /// Texels per side of the light's map.
    pub map: u32,
    /// Of the blur that the filtered map has.
    pub radius: u32,
    /// Width and height of the picture.
    pub picture: [u32; 2],
    /// Steps of the truth.
    pub steps: u32,
}

/// A drawn scene with its truth.
pub struct ScatteringStage {
    /// What is in its air.
    pub air: Air,
    /// Rays that are marched through the plain map.
    pub truth: MarchedRays,
    /// Rays that are marched through the filtered map.
    pub filtered: MarchedRays,
    /// With [`SAMPLES`] samples per texel, and with one.
    frames: [Frame; 2],
    uniform: ScatteringView,
}

/// What competitors are told: the uniform struct of `view.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
struct ScatteringView {
    frame: RectifiedFrame,
    medium: SingleScattering,
    map_at_camera: [f32; 2],
    map_along_first: [f32; 2],
    map_along_second: [f32; 2],
    depth_at_camera: f32,
    depth_per_length: f32,
}

impl ScatteringStage {
    /// Draws the scene and marches its rays.
    pub fn new(gpu: &Gpu, scene: &Scene, desc: &ScatteringStageDesc) -> Result<Self, LabError> {
        let view = desc.look.view(scene);
        let map = [desc.map; 2];
        let margin = f64::from(desc.radius) + MARGIN;
        let light = view.sun(scene, map, margin, false)?;
        let mut camera = view.camera;
        camera.aspect = f64::from(desc.picture[0]) / f64::from(desc.picture[1].max(1));
        let bounds = scene.bounds();
        let far = (bounds.centre() - camera.eye).length() + BEHIND * bounds.radius();
        let air = Air::new(desc.thickness, desc.anisotropy, far)?;
        let frame = |samples| {
            let desc = FrameDesc {
                picture: desc.picture,
                map,
                samples,
                format: wgpu::TextureFormat::Depth32Float,
                light,
                shape: LightShape::Directional {
                    angular_diameter: 0.0,
                },
                camera,
            };
            Frame::draw(gpu, scene, desc)
        };
        let frames = [frame(SAMPLES)?, frame(1)?];
        let ends = ends(gpu, &frames[1].desc, &frames[1].surface, far)?;
        let depth = read_depth_samples(gpu, &frames[1].light_map.texture)?;
        let rays = Rays {
            eye: camera.eye,
            ends: &ends,
            light: &light,
            depth: &depth,
            medium: &air.medium,
            steps: desc.steps,
        };
        let kernel = Kernel::gaussian(desc.radius, 0.6 * desc.radius as f32)?;
        let parameters = scattering_parameters(&frames[0].desc, &air)?;
        Ok(Self {
            truth: marched(&rays),
            filtered: marched_filtered(&rays, &TapPattern::of_kernel(&kernel), desc.radius),
            air,
            frames,
            uniform: ScatteringView::of(&parameters),
        })
    }

    /// The frame with several samples per texel of the light's map.
    #[must_use]
    pub fn frame(&self) -> &Frame {
        &self.frames[0]
    }

    /// The frame with one sample per texel of the light's map.
    #[must_use]
    pub fn plain(&self) -> &Frame {
        &self.frames[1]
    }

    /// The uniform buffer of competitors.
    pub(super) fn uniform(&self, gpu: &Gpu) -> wgpu::Buffer {
        gpu.device
            .create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("scattering/view"),
                contents: bytes_of(&self.uniform),
                usage: wgpu::BufferUsages::UNIFORM,
            })
    }
}

impl ScatteringView {
    fn of(parameters: &ScatteringParameters) -> Self {
        let rectify = &parameters.rectify;
        Self {
            frame: rectify.frame,
            medium: parameters.composite.medium,
            map_at_camera: rectify.map_at_camera,
            map_along_first: rectify.map_along_first,
            map_along_second: rectify.map_along_second,
            depth_at_camera: rectify.depth_at_camera,
            depth_per_length: rectify.depth_per_length,
        }
    }
}

/// From the camera to what each pixel shows, or to the far end.
pub(super) fn ends(
    gpu: &Gpu,
    desc: &FrameDesc,
    surface: &Surface,
    far: f64,
) -> Result<Vec<DVec3>, LabError> {
    let pixels = read_gbuffer(gpu, surface)?;
    let camera = &desc.camera;
    let axis = (camera.target - camera.eye).normalize();
    let world_from_clip = camera.clip_from_world()?.inverse();
    let [width, height] = desc.picture;
    let directions = (0..height).flat_map(|y| {
        (0..width).map(move |x| {
            let device = [
                (2.0 * f64::from(x) + 1.0) / f64::from(width) - 1.0,
                1.0 - (2.0 * f64::from(y) + 1.0) / f64::from(height),
            ];
            world_from_clip.project_point3(DVec3::new(device[0], device[1], 1.0)) - camera.eye
        })
    });
    let surfaces = pixels.position.iter().zip(&pixels.covered);
    Ok(directions
        .zip(surfaces)
        .map(|(direction, (position, &covered))| {
            let end = direction * (far / direction.dot(axis));
            let surface = DVec3::from(position.map(f64::from)) - camera.eye;
            if covered && surface.dot(axis) < far {
                surface
            } else {
                end
            }
        })
        .collect())
}
