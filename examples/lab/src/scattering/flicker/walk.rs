//! A path, drawn frame by frame with textures and pipelines that are made once.

use super::{Chain, FlickerDesc, Path};
use crate::compare::Technique;
use crate::error::LabError;
use crate::frame::{Frame, FrameDesc};
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;
use crate::host::read_depth_samples;
use crate::light::LightShape;
use crate::scattering::air::{ANISOTROPY, Air, THICKNESS, far};
use crate::scattering::stage::{ends, read_radiance};
use crate::scattering::truth::{Rays, marched};
use crate::scene::Scene;

/// Texels that maps leave free around the casters.
const MARGIN: f64 = 4.0;

/// What a frame looks like: the mean of the colours' radiance of each pixel.
pub(super) struct Seen {
    /// Radiance by marched rays.
    pub(super) truth: Vec<f32>,
    /// Radiance by marched rays without shadows.
    pub(super) unshadowed: Vec<f32>,
    /// Radiance by each chain.
    pub(super) chains: Vec<Vec<f32>>,
}

/// Everything that is drawn with.
pub(super) struct Walk<'a> {
    gpu: &'a Gpu,
    scene: &'a Scene,
    desc: FlickerDesc,
    path: Path,
    air: Air,
    /// Frames with several samples per texel, with one, and that of the truth.
    frames: [Frame; 3],
    chains: Vec<(Chain, GraphFile, GraphFrame)>,
}

impl<'a> Walk<'a> {
    /// Makes everything that frames are drawn with.
    pub(super) fn new(
        gpu: &'a Gpu,
        scene: &'a Scene,
        desc: &FlickerDesc,
    ) -> Result<Self, LabError> {
        let path = Path::new(scene);
        let air = Air::new(THICKNESS, ANISOTROPY, far(scene, path.view(0).camera.eye))?;
        let frame = |index| Frame::draw(gpu, scene, frame_desc(scene, desc, &path, 0, index)?);
        let frames = [frame(0)?, frame(1)?, frame(2)?];
        let chains = Chain::ALL.into_iter().map(|chain| {
            let file = chain.graph(desc.extent())?;
            let frame = &frames[usize::from(chain.is_plain())];
            let graph = GraphFrame::in_air(gpu, frame, &file, Some(&air))?;
            Ok((chain, file, graph))
        });
        Ok(Self {
            gpu,
            scene,
            desc: *desc,
            path,
            air,
            chains: chains.collect::<Result<_, LabError>>()?,
            frames,
        })
    }

    /// Draws a frame and lights its air.
    pub(super) fn see(&mut self, number: u32) -> Result<Seen, LabError> {
        let gpu = self.gpu;
        for (index, frame) in self.frames.iter_mut().enumerate() {
            let desc = frame_desc(self.scene, &self.desc, &self.path, number, index)?;
            frame.redraw(gpu, self.scene, desc)?;
        }
        let [truth, unshadowed] = self.truth()?;
        let chains = self.chains.iter().map(|(chain, file, graph)| {
            let frame = &self.frames[usize::from(chain.is_plain())];
            graph.fill(gpu, &frame.desc, file, Some(&self.air))?;
            graph.run(gpu)?;
            let pixels = read_radiance(gpu, graph.output()?)?;
            let grey = |pixel: &[f32; 4]| pixel[..3].iter().sum::<f32>() / 3.0;
            Ok(pixels.iter().map(grey).collect())
        });
        Ok(Seen {
            truth,
            unshadowed,
            chains: chains.collect::<Result<_, LabError>>()?,
        })
    }

    /// Radiance with shadows and without.
    fn truth(&self) -> Result<[Vec<f32>; 2], LabError> {
        let frame = &self.frames[2];
        let rays = marched(&Rays {
            eye: frame.desc.camera.eye,
            ends: &ends(self.gpu, &frame.desc, &frame.surface, self.air.far)?,
            light: &frame.desc.light,
            depth: &read_depth_samples(self.gpu, &frame.light_map.texture)?,
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

/// A frame of the path, with one of the maps.
fn frame_desc(
    scene: &Scene,
    desc: &FlickerDesc,
    path: &Path,
    number: u32,
    index: usize,
) -> Result<FrameDesc, LabError> {
    let view = path.view(number);
    let mut camera = view.camera;
    camera.aspect = f64::from(desc.width) / f64::from(desc.height.max(1));
    let (map, samples) = [(desc.map, 4), (desc.map, 1), (desc.truth_map, 1)][index];
    let map = [map; 2];
    Ok(FrameDesc {
        picture: [desc.width, desc.height],
        map,
        samples,
        format: wgpu::TextureFormat::Depth32Float,
        light: view.sun(scene, map, MARGIN, false)?,
        shape: LightShape::Directional {
            angular_diameter: 0.0,
        },
        camera,
    })
}
