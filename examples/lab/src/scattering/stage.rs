//! A scene with something in its air, drawn, with the truth of what the camera sees of it.

use bytemuck::{Pod, Zeroable, bytes_of};
use glam::DVec3;
use moment_shadows::{Kernel, RectifiedFrame, ScatteringParameters, SingleScattering};
use wgpu::util::DeviceExt;

use super::air::{Air, THICKNESS};
use super::candidate::ScatteringCandidate;
use super::look::LookDesc;
use super::report::{ScatteringError, ScatteringErrors};
use super::truth::{MarchedRays, Rays, marched, marched_filtered};
use crate::compare::{Shown, Stage, Technique};
use crate::error::LabError;
use crate::frame::{Frame, FrameDesc};
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::{GraphFrame, scattering_parameters};
use crate::host::{Surface, read_depth_samples, read_gbuffer};
use crate::light::LightShape;
use crate::picture::signed_difference;
use crate::scene::Scene;
use crate::truth::kernel::TapPattern;
use crate::view::View;

/// Samples per texel of the map, for techniques that can have several.
const SAMPLES: u32 = 4;

/// Texels that the map leaves free around the casters beyond the blur's radius.
const MARGIN: f64 = 2.0;

/// A difference that is shown in full colour, in parts of the mean radiance without shadows.
pub(super) const FULL_DIFFERENCE: f32 = 0.5;

/// What the mean radiance without shadows is in pictures, on a scale from black to white.
pub(super) const EXPOSURE: f64 = 0.35;

/// The chain that lights the surfaces of pictures.
const SURFACES: &str = include_str!("../../../hard_shadows.json");

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, clap::Args)]
pub struct ScatteringStageDesc {
    /// The viewpoint.
    #[command(flatten)]
    pub look: LookDesc,
    /// Texels per side of the light's map.
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub map: u32,
    /// Radius in texels of the blur of the light's map.
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u32).range(1..=64))]
    pub radius: u32,
    /// Columns of rectified maps.
    #[arg(long, default_value_t = 512, value_parser = clap::value_parser!(u32).range(2..=8192))]
    pub columns: u32,
    /// Rows of rectified maps.
    #[arg(long, default_value_t = 512, value_parser = clap::value_parser!(u32).range(2..=8192))]
    pub rows: u32,
    /// Width of the picture.
    #[arg(long, default_value_t = 640, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub width: u32,
    /// Height of the picture.
    #[arg(long, default_value_t = 360, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub height: u32,
    /// Steps of the truth.
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    pub steps: u32,
}

impl ScatteringStageDesc {
    /// Columns and rows of rectified maps.
    #[must_use]
    pub fn extent(&self) -> [u32; 2] {
        [self.columns, self.rows]
    }
}

/// A drawn scene with its truth.
pub struct ScatteringStage {
    /// What is in its air.
    pub air: Air,
    /// Rays that are marched through the plain map.
    pub truth: MarchedRays,
    /// Rays that are marched through the filtered map.
    pub filtered: MarchedRays,
    /// Frames with [`SAMPLES`] samples per texel, and with one.
    frames: [Frame; 2],
    uniform: ScatteringView,
    scene: String,
    desc: ScatteringStageDesc,
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
        let margin = f64::from(desc.radius) + MARGIN;
        let picture = [desc.width, desc.height];
        let drawn = sunlit(scene, &view, picture, (desc.map, SAMPLES), margin)?;
        let air = Air::of(scene, drawn.camera.eye)?;
        let frames = Frame::pair(gpu, scene, drawn)?;
        let ends = ends(gpu, &frames[1].desc, &frames[1].surface, air.far)?;
        let depth = read_depth_samples(gpu, &frames[1].light_map.texture)?;
        let rays = Rays {
            eye: drawn.camera.eye,
            ends: &ends,
            light: &drawn.light,
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
            scene: scene.name.clone(),
            desc: *desc,
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

impl Stage for ScatteringStage {
    type Candidate = ScatteringCandidate;
    type Picture = Vec<[f32; 4]>;
    type Errors = ScatteringErrors;

    fn name(candidate: &ScatteringCandidate) -> &str {
        &candidate.name
    }

    fn bind(
        &self,
        gpu: &Gpu,
        candidate: &ScatteringCandidate,
    ) -> Result<Box<dyn Technique>, LabError> {
        candidate.bind(gpu, self)
    }

    fn read(&self, gpu: &Gpu, output: &wgpu::Texture) -> Result<Vec<[f32; 4]>, LabError> {
        read_radiance(gpu, output)
    }

    fn errors(
        &self,
        candidate: &ScatteringCandidate,
        picture: &Vec<[f32; 4]>,
    ) -> Result<ScatteringErrors, LabError> {
        Ok(ScatteringErrors {
            ours: candidate.is_ours(),
            fetches: candidate.fetches,
            plain: ScatteringError::of(picture, &self.truth),
            filtered: ScatteringError::of(picture, &self.filtered),
            steps: candidate.steps(),
        })
    }

    fn show(&self, gpu: &Gpu, pictures: &[Vec<[f32; 4]>]) -> Result<Shown, LabError> {
        let file = GraphFile::parse("hard_shadows.json", SURFACES.to_owned(), None)?;
        let graph = GraphFrame::new(gpu, self.frame(), &file)?;
        graph.run(gpu)?;
        let surfaces = self.frame().picture(gpu, graph.shadow(&file)?)?;
        let brightness = mean(&self.truth.unshadowed).iter().sum::<f64>() / 3.0;
        // The truth has no alpha; that of any candidate is exact.
        let dimming = pictures.first().map_or(&[][..], Vec::as_slice);
        let truth: Vec<[f32; 4]> = (self.truth.radiance.iter().zip(dimming))
            .map(|(&[red, green, blue], dimming)| [red, green, blue, dimming[3]])
            .collect();
        let grey = |picture: &[[f32; 4]]| -> Vec<f32> {
            let mean = |pixel: &[f32; 4]| (pixel[0] + pixel[1] + pixel[2]) / 3.0;
            (picture.iter().map(mean))
                .map(|mean| mean / brightness as f32)
                .collect()
        };
        let exposure = EXPOSURE / brightness;
        let shown = |picture: &Vec<[f32; 4]>| {
            // Too bright is blue, as too little shadow is.
            let difference = signed_difference(&grey(&truth), &grey(picture), FULL_DIFFERENCE);
            [lit(&surfaces, picture, exposure), difference]
        };
        Ok(Shown {
            pictures: pictures.iter().map(shown).collect(),
            truth: lit(&surfaces, &truth, exposure),
        })
    }

    fn setting(&self) -> String {
        let [unshadowed, lit] = [&self.truth.unshadowed, &self.truth.radiance]
            .map(|radiance| mean(radiance).iter().sum::<f64>());
        let ScatteringStageDesc {
            map,
            columns,
            rows,
            width,
            height,
            steps,
            ..
        } = self.desc;
        format!(
            "{}, view {}: map {map}x{map}, rectified {columns}x{rows}, picture {width}x{height}, optical thickness {THICKNESS}; \
             {:.0} % in shadow; errors are parts of the mean radiance without shadows; truths of {steps} steps",
            self.scene,
            self.desc.look.look.name(),
            100.0 * (1.0 - lit / unshadowed.max(1e-300)),
        )
    }

    fn stem(&self) -> String {
        format!("{}-{}", self.scene, self.desc.look.look.name())
    }

    fn desc(&self) -> &FrameDesc {
        &self.frame().desc
    }
}

/// The mean by colour.
pub(super) fn mean(values: &[[f32; 3]]) -> [f64; 3] {
    [0, 1, 2].map(|colour| {
        let sum: f64 = values.iter().map(|value| f64::from(value[colour])).sum();
        sum / values.len().max(1) as f64
    })
}

/// Radiance and transmittance per pixel, the top row first.
pub(super) fn read_radiance(gpu: &Gpu, texture: &wgpu::Texture) -> Result<Vec<[f32; 4]>, LabError> {
    let bytes = gpu.read_texture(texture, 0, "radiance")?;
    let halves = bytes.chunks_exact(8).map(|pixel| {
        std::array::from_fn(|channel| {
            half::f16::from_le_bytes([pixel[2 * channel], pixel[2 * channel + 1]]).to_f32()
        })
    });
    Ok(halves.collect())
}

/// Radiance in front of a picture of sRGB bytes.
pub(super) fn lit(surfaces: &[u8], radiance: &[[f32; 4]], exposure: f64) -> Vec<u8> {
    let mut picture = surfaces.to_vec();
    for (pixel, light) in picture.chunks_exact_mut(4).zip(radiance) {
        for (byte, &colour) in pixel.iter_mut().zip(&light[..3]) {
            let behind = (f64::from(*byte) / 255.0).powf(2.2) * f64::from(light[3]);
            let sum = behind + exposure * f64::from(colour);
            *byte = (sum.clamp(0.0, 1.0).powf(1.0 / 2.2) * 255.0).round() as u8;
        }
    }
    picture
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

/// A view of a scene under a sun, with the sides and the samples per texel of a map that leaves so many texels free around the
/// casters.
pub(super) fn sunlit(
    scene: &Scene,
    view: &View,
    picture: [u32; 2],
    (map, samples): (u32, u32),
    margin: f64,
) -> Result<FrameDesc, LabError> {
    let map = [map; 2];
    let mut camera = view.camera;
    camera.aspect = f64::from(picture[0]) / f64::from(picture[1].max(1));
    Ok(FrameDesc {
        picture,
        map,
        samples,
        format: wgpu::TextureFormat::Depth32Float,
        camera_depth: (wgpu::TextureFormat::Depth32Float, 1),
        light: view.sun(scene, map, margin, false)?,
        shape: LightShape::Directional {
            angular_diameter: 0.0,
        },
        camera,
    })
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
            // The ray is that of the pixel's centre: rasterisers move vertices to a grid, and with them what a pixel shows.
            let surface = DVec3::from(position.map(f64::from)) - camera.eye;
            let distance = if covered {
                surface.dot(axis).min(far)
            } else {
                far
            };
            direction * (distance / direction.dot(axis))
        })
        .collect())
}
