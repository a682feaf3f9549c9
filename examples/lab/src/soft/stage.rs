//! A scene under an area light, drawn, with the truth of what the camera sees.

use glam::DVec3;

use super::candidate::SoftCandidate;
use super::light::{LightSize, SoftLightChoice};
use crate::error::LabError;
use crate::frame::{Frame, FrameDesc};
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;
use crate::host::{SurfacePixels, read_gbuffer};
use crate::judgement::facing;
use crate::metric::{Comparison, compare};
use crate::penumbra::{Profile, edge_widths};
use crate::scene::{EDGE, EDGE_HEIGHTS, Scene};
use crate::truth::area_light::{AreaLight, USUAL_PLACES};
use crate::view::View;

/// Samples per texel of the map, for techniques that can have several.
const SAMPLES: u32 = 4;

/// Texels that the map leaves free around the casters at least: the hard technique's kernel and a bilinear lookup.
const MARGIN: f64 = 6.0;

/// Intervals over which profiles are averaged, per width of the penumbra.
const BINS: f64 = 40.0;

/// What is drawn, under which light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StageDesc {
    /// What kind of area light.
    pub light: SoftLightChoice,
    /// Its size; the usual one where it is not given.
    pub size: Option<LightSize>,
    /// The numbered viewpoint.
    pub view: u32,
    /// Texels per side of the light's map.
    pub map: u32,
    /// Width and height of the picture.
    pub picture: [u32; 2],
    /// Places on the light that the truth is the mean of.
    pub places: u32,
}

impl Default for StageDesc {
    fn default() -> Self {
        Self {
            light: SoftLightChoice::Directional,
            size: None,
            view: 0,
            map: 1024,
            picture: [1280, 720],
            places: USUAL_PLACES,
        }
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
    /// Whether it is the scene of straight edges.
    edges: bool,
    /// With [`SAMPLES`] samples per texel, and with one.
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
        camera.aspect = f64::from(desc.picture[0]) / f64::from(desc.picture[1].max(1));
        let frame = |samples| {
            let desc = FrameDesc {
                picture: desc.picture,
                map,
                samples,
                format: wgpu::TextureFormat::Depth32Float,
                light,
                shape,
                camera,
            };
            Frame::draw(gpu, scene, desc)
        };
        let frames = [frame(SAMPLES)?, frame(1)?];
        let pixels = read_gbuffer(gpu, &frames[0].surface)?;
        let truth = AreaLight::new(scene, &light, shape, map, desc.places)?.picture(&pixels)?;
        let mut judged = facing(&light, &pixels);
        for (judged, position) in judged.iter_mut().zip(&pixels.position) {
            let uv = light.uv(DVec3::from(position.map(f64::from)));
            *judged &= uv.is_some_and(|uv| uv.min_element() >= 0.0 && uv.max_element() <= 1.0);
        }
        Ok(Self {
            truth,
            judged,
            pixels,
            edges: scene.name == EDGE,
            frames,
        })
    }

    /// The frame that a graph reads: with several samples per texel where it can have them.
    #[must_use]
    pub fn frame(&self, file: &GraphFile) -> &Frame {
        &self.frames[usize::from(file.reads_depth())]
    }

    /// What was drawn, under which light.
    #[must_use]
    pub fn desc(&self) -> &FrameDesc {
        &self.frames[0].desc
    }

    /// Runs a candidate.
    pub fn picture(&self, gpu: &Gpu, candidate: &SoftCandidate) -> Result<SoftPicture, LabError> {
        let frame = self.frame(&candidate.file);
        let graph_frame = GraphFrame::new(gpu, frame, &candidate.file)?;
        graph_frame.run(gpu)?;
        Ok(SoftPicture {
            shadow: graph_frame.read_shadow(gpu, &candidate.file)?,
            lit: frame.picture(gpu, graph_frame.shadow(&candidate.file)?)?,
        })
    }

    /// The lit picture of the truth, sRGB bytes with alpha.
    pub fn lit_truth(&self, gpu: &Gpu) -> Result<Vec<u8>, LabError> {
        let [width, height] = self.desc().picture;
        let size = wgpu::Extent3d {
            width,
            height,
            depth_or_array_layers: 1,
        };
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("lab/area light"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::R32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        gpu.queue.write_texture(
            texture.as_image_copy(),
            bytemuck::cast_slice(&self.truth),
            wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(4 * width),
                rows_per_image: None,
            },
            size,
        );
        self.frames[0].picture(gpu, &texture)
    }

    /// The error of a picture of shadow intensity over the judged pixels.
    pub fn judge(&self, shadow: &[f32]) -> Result<Comparison, LabError> {
        Ok(compare(shadow, &self.truth, &self.judged)?)
    }

    /// In the scene of straight edges the width of the penumbra below each board, 10 % to 90 %, as geometry has it.
    #[must_use]
    pub fn exact_widths(&self) -> Option<[f64; EDGE_HEIGHTS.len()]> {
        let desc = self.desc();
        self.edges.then(|| edge_widths(&desc.light, desc.shape))
    }

    /// The same measured on a picture of shadow intensity; none where the profile does not lead from light to shadow.
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
