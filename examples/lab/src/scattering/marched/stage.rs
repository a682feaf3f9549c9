//! A scene in height fog under any light, drawn, with the truth of what the camera sees of it.

use moment_shadows::{CameraView, HeightFog, LightView, MarchedAir};
use moment_shadows_graph::Capabilities;

use super::bound::{Bound, BoundMarch};
use super::candidate::MarchCandidate;
use super::lamp::{Face, Lamp};
use super::report::MarchErrors;
use super::truth::LampRays;
use crate::compare::{Shown, Stage, Technique};
use crate::error::LabError;
use crate::frame::{Frame, FrameDesc};
use crate::gpu::Gpu;
use crate::graph_frame::{camera_view, light_view};
use crate::host::{DepthSamples, read_depth_samples};
use crate::light::LightShape;
use crate::picture::signed_difference;
use crate::scattering::air::Air;
use crate::scattering::look::LookDesc;
use crate::scattering::report::ScatteringError;
use crate::scattering::stage::{EXPOSURE, FULL_DIFFERENCE, ends, lit, mean, read_radiance, sunlit};
use crate::scattering::truth::MarchedRays;
use crate::scene::Scene;
use crate::texture::layered;

/// Samples per texel of the maps that are filtered.
const SAMPLES: u32 = 4;

/// Texels that a sun's map leaves free around the casters beyond the blur's radius.
const MARGIN: f64 = 2.0;

/// What is drawn.
#[derive(Clone, Copy, Debug, PartialEq, clap::Args)]
pub struct MarchStageDesc {
    /// The viewpoint.
    #[command(flatten)]
    pub look: LookDesc,
    /// The light.
    #[arg(long, value_enum, default_value = "spot")]
    pub light: Lamp,
    /// By how much the logarithm of the density falls over the scene's radius; 0 for a homogeneous medium.
    #[arg(long, default_value_t = 2.0)]
    pub falloff: f64,
    /// Texels per side of each map of the light.
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(64..=8192))]
    pub map: u32,
    /// Radius in texels of the blur of maps.
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u32).range(1..=3))]
    pub radius: u32,
    /// Width of the picture.
    #[arg(long, default_value_t = 640, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub width: u32,
    /// Height of the picture.
    #[arg(long, default_value_t = 360, value_parser = clap::value_parser!(u32).range(16..=8192))]
    pub height: u32,
    /// Steps of the truth.
    #[arg(long, default_value_t = 1024, value_parser = clap::value_parser!(u32).range(1..=65_536))]
    pub steps: u32,
    /// Looks up the middles of steps, instead of shifting them by blue noise.
    #[arg(long)]
    pub undithered: bool,
}

impl MarchStageDesc {
    /// How many views the light has.
    #[must_use]
    pub fn views(&self) -> usize {
        match self.light {
            Lamp::Sun | Lamp::Spot => 1,
            Lamp::Point => 6,
        }
    }
}

/// A drawn scene with its truth.
pub struct MarchStage {
    /// Rays that are marched through the plain maps.
    pub truth: MarchedRays,
    /// A frame of each view, with [`SAMPLES`] samples per texel.
    frames: Vec<Frame>,
    /// The light's depth maps with as many, and those with one in one texture.
    maps: Vec<wgpu::Texture>,
    plain: wgpu::Texture,
    views: Vec<LightView>,
    camera: CameraView,
    air: Air,
    marched: MarchedAir,
    capabilities: Capabilities,
    scene: String,
    desc: MarchStageDesc,
}

impl MarchStage {
    /// Draws the scene and marches its rays.
    pub fn new(gpu: &Gpu, scene: &Scene, desc: &MarchStageDesc) -> Result<Self, LabError> {
        let view = desc.look.view(scene);
        let margin = f64::from(desc.radius) + MARGIN;
        let picture = [desc.width, desc.height];
        let drawn = sunlit(scene, &view, picture, (desc.map, SAMPLES), margin)?;
        let faces = desc.light.views(scene, &view, desc.map, margin)?;
        let mut pairs = Vec::new();
        for (light, _) in &faces {
            let shape = match desc.light {
                Lamp::Sun => drawn.shape,
                Lamp::Spot | Lamp::Point => LightShape::Disk { diameter: 0.0 },
            };
            let light = *light;
            pairs.push(Frame::pair(
                gpu,
                scene,
                FrameDesc {
                    light,
                    shape,
                    ..drawn
                },
            )?);
        }
        let (frames, plain_frames): (Vec<_>, Vec<_>) =
            pairs.into_iter().map(<(_, _)>::from).unzip();
        let textures = |frames: &[Frame]| -> Vec<wgpu::Texture> {
            (frames.iter())
                .map(|it| it.light_map.texture.clone())
                .collect()
        };
        let plain = layered(gpu, &textures(&plain_frames))?;
        let eye = drawn.camera.eye;
        let position = desc.light.position(scene, &view);
        let mut air = Air::of(scene, eye)?;
        if let Some(position) = position {
            // As bright in the scene's middle as the sun.
            let square = (scene.bounds().centre() - position).length_squared();
            let least = (0.25 * scene.bounds().radius()).powi(2);
            let brighter = square.max(least) as f32;
            air.medium.irradiance = air.medium.irradiance.map(|it| brighter * it);
        }
        let marched = MarchedAir {
            fog: HeightFog {
                falloff: desc.falloff / scene.bounds().radius(),
                height: eye.y,
                ..HeightFog::NONE
            },
            cone: desc.light.cone(),
            ..MarchedAir::default()
        };
        let ends = ends(gpu, &drawn, &frames[0].surface, air.far)?;
        let mut mapped: Vec<(Face, DepthSamples)> = Vec::new();
        for (face, frame) in faces.iter().zip(&plain_frames) {
            mapped.push((*face, read_depth_samples(gpu, &frame.light_map.texture)?));
        }
        let rays = LampRays {
            eye,
            ends: &ends,
            faces: &mapped,
            lamp: position.map(|at| (at, air.far / 1024.0)),
            direction: view.light_direction.normalize(),
            medium: &air.medium,
            air: &marched,
            steps: desc.steps,
        };
        let views = (0..).zip(&frames).zip(&faces);
        let views = views.map(|((layer, frame), (_, guard))| LightView {
            layer,
            guard: *guard,
            ..light_view(&frame.desc)
        });
        Ok(Self {
            truth: rays.march(),
            maps: textures(&frames),
            views: views.collect(),
            camera: camera_view(&drawn)?,
            plain,
            frames,
            air,
            marched,
            capabilities: Capabilities::of_device(&gpu.adapter, &gpu.device),
            scene: scene.name.clone(),
            desc: *desc,
        })
    }

    fn bound(&self) -> Bound<'_> {
        Bound {
            maps: &self.maps,
            plain: &self.plain,
            camera_depth: self.frames[0].camera_depth(),
            camera: self.camera,
            far: self.air.far,
            views: &self.views,
            medium: self.air.medium,
            air: self.marched,
        }
    }
}

impl Stage for MarchStage {
    type Candidate = MarchCandidate;
    type Picture = Vec<[f32; 4]>;
    type Errors = MarchErrors;

    fn name(candidate: &MarchCandidate) -> &str {
        &candidate.name
    }

    fn bind(&self, gpu: &Gpu, candidate: &MarchCandidate) -> Result<Box<dyn Technique>, LabError> {
        Ok(Box::new(BoundMarch::new(gpu, candidate, &self.bound())?))
    }

    fn read(&self, gpu: &Gpu, output: &wgpu::Texture) -> Result<Self::Picture, LabError> {
        read_radiance(gpu, output)
    }

    fn errors(
        &self,
        candidate: &MarchCandidate,
        picture: &Self::Picture,
    ) -> Result<MarchErrors, LabError> {
        let plan = BoundMarch::plan(&self.capabilities, candidate, &self.bound())?;
        Ok(MarchErrors {
            lookups: candidate.lookups,
            error: ScatteringError::of(picture, &self.truth),
            bytes_resident: plan.bytes_resident(),
            bytes_moved: plan.bytes_moved(),
        })
    }

    fn show(&self, _: &Gpu, pictures: &[Self::Picture]) -> Result<Shown, LabError> {
        let brightness = mean(&self.truth.unshadowed).iter().sum::<f64>() / 3.0;
        let black = vec![0; 4 * self.truth.radiance.len()];
        let truth: Vec<[f32; 4]> = (self.truth.radiance.iter())
            .map(|&[red, green, blue]| [red, green, blue, 1.0])
            .collect();
        let grey = |picture: &[[f32; 4]]| -> Vec<f32> {
            let mean = |pixel: &[f32; 4]| (pixel[0] + pixel[1] + pixel[2]) / 3.0;
            (picture.iter().map(mean))
                .map(|mean| mean / brightness as f32)
                .collect()
        };
        let exposure = EXPOSURE / brightness;
        let shown = |picture: &Self::Picture| {
            let difference = signed_difference(&grey(&truth), &grey(picture), FULL_DIFFERENCE);
            [lit(&black, picture, exposure), difference]
        };
        Ok(Shown {
            pictures: pictures.iter().map(shown).collect(),
            truth: lit(&black, &truth, exposure),
        })
    }

    fn setting(&self) -> String {
        let [unshadowed, lit] = [&self.truth.unshadowed, &self.truth.radiance]
            .map(|radiance| mean(radiance).iter().sum::<f64>());
        let MarchStageDesc {
            map,
            radius,
            width,
            height,
            steps,
            falloff,
            ..
        } = self.desc;
        format!(
            "{}, view {}, {}: density falls by e^{falloff} over the scene's radius; {} map of {map}x{map}, blur of {radius}, picture \
             {width}x{height}; {:.0} % in shadow; errors are parts of the mean radiance without shadows; truth of {steps} steps",
            self.scene,
            self.desc.look.look.name(),
            self.desc.light.name(),
            self.views.len(),
            100.0 * (1.0 - lit / unshadowed.max(1e-300)),
        )
    }

    fn stem(&self) -> String {
        let look = self.desc.look.look.name();
        format!("{}-{}-{}", self.scene, self.desc.light.name(), look)
    }

    fn desc(&self) -> &FrameDesc {
        &self.frames[0].desc
    }
}
