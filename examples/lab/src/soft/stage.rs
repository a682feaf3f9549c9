//! A scene under an area light, drawn, with the truth of what the camera sees.

use glam::DVec3;
use moment_shadows::TextureFormat;
use moment_shadows_graph::TextureDesc;

use super::candidate::SoftCandidate;
use super::light::{LightSize, SoftLightChoice};
use super::report::SoftErrors;
use crate::command::argument::defaults;
use crate::compare::{Shown, Stage, Technique};
use crate::error::LabError;
use crate::frame::{Frame, FrameDesc};
use crate::gpu::Gpu;
use crate::graph_frame::{GraphFrame, read_intensity};
use crate::host::{SurfacePixels, read_gbuffer};
use crate::judgement::facing;
use crate::light::LightShape;
use crate::metric::{Comparison, compare};
use crate::penumbra::{Profile, edge_widths};
use crate::picture::signed_difference;
use crate::scene::{EDGE, EDGE_HEIGHTS, Scene};
use crate::texture::upload;
use crate::truth::area_light::{AreaLight, MOST_PLACES, USUAL_PLACES};
use crate::view::View;

/// Samples per texel of the map, for techniques that can have several.
const SAMPLES: u32 = 4;

/// Texels that the map leaves free around the casters at least: the hard technique's kernel and a bilinear lookup.
const MARGIN: f64 = 6.0;

/// Intervals over which profiles are averaged, per width of the penumbra.
const BINS: f64 = 40.0;

/// A difference of shadow intensity that is shown in full colour.
const FULL_DIFFERENCE: f32 = 0.5;

/// What is drawn, under which light.
#[derive(Clone, Copy, Debug, PartialEq, clap::Args)]
pub struct StageDesc {
    /// The light.
    #[arg(long, value_enum, default_value = "directional")]
    pub light: SoftLightChoice,
    /// The light's size: degrees for a directional one, a diameter in scene units for a spot, WIDTHxHEIGHT for a rectangle. 0
    /// gives hard shadows.
    #[arg(long)]
    pub size: Option<LightSize>,
    /// One of the numbered viewpoints and light directions.
    #[arg(long, default_value_t = 0)]
    pub view: u32,
    /// Texels per side of the light's map.
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub map: u32,
    /// Width of the picture.
    #[arg(long, default_value_t = 640, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub width: u32,
    /// Height of the picture.
    #[arg(long, default_value_t = 360, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub height: u32,
    /// Places on the light that the truth is the mean of.
    #[arg(long = "samples", default_value_t = USUAL_PLACES, value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_PLACES)))]
    pub places: u32,
}

impl Default for StageDesc {
    fn default() -> Self {
        defaults(&[])
    }
}

/// A drawn scene with its truth.
pub struct SoftStage {
    /// Shadow intensity per pixel under the sampled light.
    pub truth: Vec<f32>,
    /// Pixels that show a surface which faces the light's centre and lies within its map.
    pub judged: Vec<bool>,
    /// What the camera sees.
    pub pixels: SurfacePixels,
    scene: String,
    choice: StageDesc,
    /// Frames with [`SAMPLES`] samples per texel, and with one.
    frames: [Frame; 2],
}

/// What a technique gives.
pub struct SoftPicture {
    /// Shadow intensity per pixel.
    pub shadow: Vec<f32>,
    /// The lit picture, sRGB bytes with alpha.
    pub lit: Vec<u8>,
}

impl SoftStage {
    /// Draws the scene and computes the truth.
    pub fn new(gpu: &Gpu, scene: &Scene, desc: &StageDesc) -> Result<Self, LabError> {
        let view = View::numbered(scene, desc.view);
        let map = [desc.map; 2];
        let (light, shape) = desc.light.light(scene, &view, map, MARGIN, desc.size)?;
        let mut camera = view.camera;
        camera.aspect = f64::from(desc.width) / f64::from(desc.height.max(1));
        let drawn = FrameDesc {
            picture: [desc.width, desc.height],
            map,
            samples: SAMPLES,
            format: wgpu::TextureFormat::Depth32Float,
            camera_depth: (wgpu::TextureFormat::Depth32Float, 1),
            light,
            shape,
            camera,
        };
        let frames = Frame::pair(gpu, scene, drawn)?;
        let pixels = read_gbuffer(gpu, &frames[0].surface)?;
        let truth = AreaLight::new(scene, &light, shape, desc.places)?.picture(&pixels)?;
        let mut judged = facing(&light, &pixels);
        for (judged, position) in judged.iter_mut().zip(&pixels.position) {
            let uv = light.uv(DVec3::from(position.map(f64::from)));
            *judged &= uv.is_some_and(|uv| uv.min_element() >= 0.0 && uv.max_element() <= 1.0);
        }
        Ok(Self {
            truth,
            judged,
            pixels,
            scene: scene.name.clone(),
            choice: *desc,
            frames,
        })
    }

    /// The lit picture of the truth, sRGB bytes with alpha.
    fn lit_truth(&self, gpu: &Gpu) -> Result<Vec<u8>, LabError> {
        let desc = TextureDesc::new(TextureFormat::R32Float, self.desc().picture);
        let texture = upload(gpu, &desc, bytemuck::cast_slice(&self.truth));
        self.frames[0].picture(gpu, &texture)
    }

    /// The error of a picture of shadow intensity over the judged pixels.
    pub fn judge(&self, shadow: &[f32]) -> Result<Comparison, LabError> {
        compare(shadow, &self.truth, &self.judged)
    }

    /// In the scene of straight edges the width of the penumbra below each board, 10 % to 90 %, as geometry has it.
    #[must_use]
    pub fn exact_widths(&self) -> Option<[f64; EDGE_HEIGHTS.len()]> {
        let desc = self.desc();
        (self.scene == EDGE).then(|| edge_widths(&desc.light, desc.shape))
    }

    /// The widths of the penumbrae as measured on a picture of shadow intensity; none where the profile does not lead from light
    /// to shadow.
    #[must_use]
    pub fn widths(&self, shadow: &[f32]) -> Option<[Option<f64>; EDGE_HEIGHTS.len()]> {
        let exact = self.exact_widths()?;
        Some(std::array::from_fn(|number| {
            // A light without size has steps; they are a pixel wide.
            let bin = (exact[number] / BINS).max(1e-3);
            Profile::of_edge(&self.pixels, shadow, number, bin).width()
        }))
    }
}

impl Stage for SoftStage {
    type Candidate = SoftCandidate;
    type Picture = SoftPicture;
    type Errors = SoftErrors;

    fn name(candidate: &SoftCandidate) -> &str {
        &candidate.name
    }

    fn bind(&self, gpu: &Gpu, candidate: &SoftCandidate) -> Result<Box<dyn Technique>, LabError> {
        // Several samples per texel where it can have them.
        let frame = &self.frames[usize::from(candidate.file.reads_depth())];
        let graph = GraphFrame::new(gpu, frame, &candidate.file)?;
        graph.shadow(&candidate.file)?;
        Ok(Box::new(graph))
    }

    fn read(&self, gpu: &Gpu, output: &wgpu::Texture) -> Result<SoftPicture, LabError> {
        Ok(SoftPicture {
            shadow: read_intensity(gpu, output)?,
            lit: self.frames[0].picture(gpu, output)?,
        })
    }

    fn errors(&self, _: &SoftCandidate, picture: &SoftPicture) -> Result<SoftErrors, LabError> {
        Ok(SoftErrors {
            error: self.judge(&picture.shadow)?,
        })
    }

    fn show(&self, gpu: &Gpu, pictures: &[SoftPicture]) -> Result<Shown, LabError> {
        let shown = |picture: &SoftPicture| {
            // Elsewhere there is no shadow that could be wrong.
            let pixels = picture.shadow.iter().zip(&self.truth).zip(&self.judged);
            let shadow: Vec<f32> = pixels
                .map(|((shadow, truth), judged)| if *judged { *shadow } else { *truth })
                .collect();
            let difference = signed_difference(&shadow, &self.truth, FULL_DIFFERENCE);
            [picture.lit.clone(), difference]
        };
        Ok(Shown {
            truth: self.lit_truth(gpu)?,
            pictures: pictures.iter().map(shown).collect(),
        })
    }

    fn setting(&self) -> String {
        let light = match self.desc().shape {
            LightShape::Directional { angular_diameter } => {
                format!("{:.3} degrees", angular_diameter.to_degrees())
            }
            LightShape::Disk { diameter } => format!("disk of {diameter:.3}"),
            LightShape::Rectangle {
                size: [width, height],
            } => format!("{width:.3} x {height:.3}"),
        };
        let StageDesc {
            map,
            width,
            height,
            places,
            ..
        } = self.choice;
        format!(
            "{}: {} light, {light}; map {map}x{map}, picture {width}x{height}; truth of {places} places",
            self.scene,
            self.choice.light.name()
        )
    }

    fn stem(&self) -> String {
        format!("{}-{}", self.scene, self.choice.light.name())
    }

    fn desc(&self) -> &FrameDesc {
        &self.frames[0].desc
    }
}
