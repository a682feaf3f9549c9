//! A path, drawn frame by frame with textures and pipelines that are made once.

use glam::DVec3;
use moment_shadows_graph::record::{
    Bindings, ImportedResource, PipelineOptions, Pipelines, Recording, Resources,
};
use moment_shadows_graph::{Capabilities, Plan, Stage, compile};
use pollster::block_on;

use super::{Chain, FlickerDesc, Path};
use crate::error::LabError;
use crate::frame::FrameDesc;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::{fill_scattering, imports, parameter_bytes, scattering_parameters};
use crate::host::{LightMap, LightMapDesc, Model, Renderer, Surface, read_depth_samples};
use crate::light::LightShape;
use crate::scattering::air::Air;
use crate::scattering::stage::ends;
use crate::scattering::truth::{Rays, marched};
use crate::scene::Scene;

/// Texels that maps leave free around the casters.
const MARGIN: f64 = 4.0;

/// How far behind the scene's middle the air ends, in parts of its radius.
const BEHIND: f64 = 1.5;

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// What a frame looks like: the mean of the colours' radiance of each pixel.
pub(super) struct Seen {
    /// By marched rays.
    pub(super) truth: Vec<f32>,
    /// The same without shadows.
    pub(super) unshadowed: Vec<f32>,
    /// By each chain.
    pub(super) chains: Vec<Vec<f32>>,
}

/// Everything that is drawn with.
pub(super) struct Walk<'a> {
    gpu: &'a Gpu,
    scene: &'a Scene,
    desc: FlickerDesc,
    path: Path,
    air: Air,
    renderer: Renderer,
    model: Model,
    surface: Surface,
    /// With several samples per texel, with one, and that of the truth.
    maps: [LightMap; 3],
    chains: Vec<BoundChain>,
}

struct BoundChain {
    chain: Chain,
    file: GraphFile,
    plan: Plan,
    parameters: wgpu::Buffer,
    bindings: Bindings,
}

/// Samples per texel of the maps.
const SAMPLES: [u32; 3] = [4, 1, 1];

impl<'a> Walk<'a> {
    /// Makes everything that frames are drawn with.
    pub(super) fn new(
        gpu: &'a Gpu,
        scene: &'a Scene,
        desc: &FlickerDesc,
    ) -> Result<Self, LabError> {
        let path = Path::new(scene, &desc.look);
        let bounds = scene.bounds();
        let eye = path.view(0).camera.eye;
        let far = (bounds.centre() - eye).length() + BEHIND * bounds.radius();
        let renderer = Renderer::new(gpu)?;
        let model = renderer.upload(gpu, scene)?;
        let surface = renderer.surface(gpu, desc.picture)?;
        let map = |index: usize| {
            let desc = LightMapDesc {
                size: size(desc, index),
                samples: SAMPLES[index],
                format: FORMAT,
                reversed: false,
            };
            renderer.light_map(gpu, &desc)
        };
        let maps = [map(0)?, map(1)?, map(2)?];
        let mut walk = Self {
            gpu,
            scene,
            desc: *desc,
            air: Air::new(desc.thickness, desc.anisotropy, far)?,
            path,
            renderer,
            model,
            surface,
            maps,
            chains: Vec::new(),
        };
        for chain in Chain::ALL {
            let bound = walk.bind(chain)?;
            walk.chains.push(bound);
        }
        Ok(walk)
    }

    fn bind(&self, chain: Chain) -> Result<BoundChain, LabError> {
        let device = &self.gpu.device;
        let file = chain.graph(self.desc.extent)?;
        let index = usize::from(chain.is_plain());
        let capabilities = Capabilities::of_device(&self.gpu.adapter, device);
        let imports = imports(&self.frame(0, index)?);
        let plan =
            compile(&file.graph, &capabilities, &imports).map_err(|error| LabError::Graph {
                file: file.name.clone(),
                error,
            })?;
        let pipelines = block_on(Pipelines::create(device, &plan, PipelineOptions::default()))?;
        let resources = block_on(Resources::create(device, &plan))?;
        let parameters = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("flicker/parameters"),
            size: u64::from(plan.parameters.size),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let given = [
            (
                "light_depth",
                ImportedResource::Texture(&self.maps[index].texture),
            ),
            (
                "camera_depth",
                ImportedResource::Texture(&self.surface.depth),
            ),
        ];
        let bindings = block_on(Bindings::create(
            device,
            &plan,
            &pipelines,
            &resources,
            &given,
            Some(&parameters),
        ))?;
        Ok(BoundChain {
            chain,
            file,
            plan,
            parameters,
            bindings,
        })
    }

    /// A frame of the path, with one of the maps.
    fn frame(&self, number: u32, index: usize) -> Result<FrameDesc, LabError> {
        let view = self.path.view(number);
        let mut camera = view.camera;
        let [width, height] = self.desc.picture.map(f64::from);
        camera.aspect = width / height.max(1.0);
        let map = size(&self.desc, index);
        Ok(FrameDesc {
            picture: self.desc.picture,
            map,
            samples: SAMPLES[index],
            format: FORMAT,
            light: view.sun(self.scene, map, MARGIN, false)?,
            shape: LightShape::Directional {
                angular_diameter: 0.0,
            },
            camera,
        })
    }

    /// Draws a frame and lights its air.
    pub(super) fn see(&self, number: u32) -> Result<Seen, LabError> {
        let frames = [0, 1, 2].map(|index| self.frame(number, index));
        let [several, one, fine] = frames;
        let frames = [several?, one?, fine?];
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        let (renderer, model) = (&self.renderer, &self.model);
        for (map, frame) in self.maps.iter().zip(&frames) {
            renderer.draw_light_depth(self.gpu, &mut encoder, model, map, &frame.light);
        }
        let camera = &frames[0].camera;
        renderer.draw_surface(self.gpu, &mut encoder, model, &self.surface, camera)?;
        self.gpu.queue.submit([encoder.finish()]);
        self.gpu.check()?;
        let [truth, unshadowed] = self.truth(&frames[2])?;
        let chains = self.chains.iter().map(|bound| {
            let frame = &frames[usize::from(bound.chain.is_plain())];
            bound.radiance(self.gpu, frame, &self.air)
        });
        Ok(Seen {
            truth,
            unshadowed,
            chains: chains.collect::<Result<_, _>>()?,
        })
    }

    /// Radiance with shadows and without.
    fn truth(&self, frame: &FrameDesc) -> Result<[Vec<f32>; 2], LabError> {
        let depth = read_depth_samples(self.gpu, &self.maps[2].texture)?;
        let ends: Vec<DVec3> = ends(self.gpu, frame, &self.surface, self.air.far)?;
        let rays = marched(&Rays {
            eye: frame.camera.eye,
            ends: &ends,
            light: &frame.light,
            depth: &depth,
            medium: &self.air.medium,
            steps: self.desc.steps,
        });
        let grey = |pixels: &[[f32; 3]]| -> Vec<f32> {
            let mean = |colours: &[f32; 3]| colours.iter().sum::<f32>() / 3.0;
            pixels.iter().map(mean).collect()
        };
        Ok([grey(&rays.radiance), grey(&rays.unshadowed)])
    }
}

/// Of one of the maps.
fn size(desc: &FlickerDesc, index: usize) -> [u32; 2] {
    let side = if index == 2 { desc.truth_map } else { desc.map };
    [side; 2]
}

impl BoundChain {
    fn radiance(&self, gpu: &Gpu, frame: &FrameDesc, air: &Air) -> Result<Vec<f32>, LabError> {
        let mut bytes = parameter_bytes(&self.plan, frame, &self.file)?;
        let parameters = scattering_parameters(frame, air)?;
        fill_scattering(&self.plan, &mut bytes, &parameters)?;
        gpu.queue.write_buffer(&self.parameters, 0, &bytes);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for stage in Stage::ALL {
            let recording = Recording::default();
            self.bindings.record(stage, &mut encoder, recording)?;
        }
        gpu.queue.submit([encoder.finish()]);
        gpu.check()?;
        let output = self.bindings.output("scattering");
        let texture = output.ok_or_else(|| LabError::Unsuitable {
            file: self.file.name.clone(),
            reason: "it has no output 'scattering'".to_owned(),
        })?;
        let bytes = gpu.read_texture(texture, 0, "radiance")?;
        let pixels = bytes.chunks_exact(8).map(|pixel| {
            let colour = |channel: usize| {
                half::f16::from_le_bytes([pixel[2 * channel], pixel[2 * channel + 1]]).to_f32()
            };
            (colour(0) + colour(1) + colour(2)) / 3.0
        });
        Ok(pixels.collect())
    }
}
