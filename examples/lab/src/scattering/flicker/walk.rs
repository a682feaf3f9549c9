//! A path, drawn frame by frame with textures and pipelines that are made once.

use moment_shadows::{Storage, Technique as MapTechnique};

use super::{FlickerDesc, Path};
use crate::compare::Technique;
use crate::error::LabError;
use crate::frame::{Frame, FrameDesc};
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;
use crate::host::read_depth_samples;
use crate::scattering::air::Air;
use crate::scattering::chain::Chain;
use crate::scattering::stage::{ends, read_radiance, sunlit};
use crate::scattering::truth::{Rays, marched};
use crate::scene::Scene;

/// Texels that maps leave free around the casters.
const MARGIN: f64 = 4.0;

/// Texels of the blur, as in the example's graph.
const RADIUS: u32 = 2;

/// Everything that is drawn with.
pub(super) struct Walk<'a> {
    gpu: &'a Gpu,
    scene: &'a Scene,
    desc: FlickerDesc,
    path: Path,
    air: Air,
    /// Frames with several samples per texel, with one, and that of the truth.
    frames: [Frame; 3],
    /// Two chains for the first, and one for the second.
    chains: [(GraphFile, GraphFrame); 3],
}

/// Chains with several samples per texel, a blur and bilinear lookups, without and, as in the example, with what is known of the
/// picture's view rays; and one with a sample per texel, no blur, and lookups of the nearest texel. All have rectified maps of
/// this extent.
pub fn chains(extent: [u32; 2]) -> Result<[GraphFile; 3], LabError> {
    let chain = |map, radius, rectify, seen| {
        let chain = Chain {
            map,
            radius,
            rectify,
            rectified: (MapTechnique::Hamburger6, Storage::Float16),
            extent,
            seen,
            composite: "composite_scattering",
        };
        chain.graph()
    };
    Ok([
        chain(Storage::Float16, Some(RADIUS), "rectify_moments", false)?,
        chain(Storage::Float16, Some(RADIUS), "rectify_moments", true)?,
        chain(Storage::Float32, None, "rectify_nearest", false)?,
    ])
}

impl<'a> Walk<'a> {
    /// Makes everything that frames are drawn with.
    pub(super) fn new(
        gpu: &'a Gpu,
        scene: &'a Scene,
        desc: &FlickerDesc,
    ) -> Result<Self, LabError> {
        let path = Path::new(scene);
        let air = Air::of(scene, path.view(0).camera.eye)?;
        let frame = |index| Frame::draw(gpu, scene, frame_desc(scene, desc, &path, 0, index)?);
        let frames = [frame(0)?, frame(1)?, frame(2)?];
        let bound = |frame: &Frame, file: GraphFile| -> Result<_, LabError> {
            let graph = GraphFrame::in_air(gpu, frame, &file, Some(&air))?;
            Ok((file, graph))
        };
        let [filtered, seen, unfiltered] = chains([desc.columns, desc.rows])?;
        let chains = [
            bound(&frames[0], filtered)?,
            bound(&frames[0], seen)?,
            bound(&frames[1], unfiltered)?,
        ];
        Ok(Self {
            gpu,
            scene,
            desc: *desc,
            path,
            air,
            chains,
            frames,
        })
    }

    /// What a frame looks like, by the mean of the colours' radiance of each pixel: by marched rays with shadows and without, and
    /// by each chain.
    pub(super) fn see(&mut self, number: u32) -> Result<[Vec<f32>; 5], LabError> {
        let gpu = self.gpu;
        for (index, frame) in self.frames.iter_mut().enumerate() {
            let desc = frame_desc(self.scene, &self.desc, &self.path, number, index)?;
            frame.redraw(gpu, self.scene, desc)?;
        }
        let frame = &self.frames[2];
        let rays = marched(&Rays {
            eye: frame.desc.camera.eye,
            ends: &ends(gpu, &frame.desc, &frame.surface, self.air.far)?,
            light: &frame.desc.light,
            depth: &read_depth_samples(gpu, &frame.light_map.texture)?,
            medium: &self.air.medium,
            steps: self.desc.steps,
        });
        let chain = |index: usize| -> Result<Vec<f32>, LabError> {
            let (file, graph) = &self.chains[index];
            let desc = &self.frames[index / 2].desc;
            graph.fill(gpu, desc, file, Some(&self.air))?;
            graph.run(gpu)?;
            let pixels = read_radiance(gpu, graph.output()?)?;
            Ok(pixels.iter().map(|pixel| grey(&pixel[..3])).collect())
        };
        let marched = |pixels: &[[f32; 3]]| pixels.iter().map(|pixel| grey(pixel)).collect();
        Ok([
            marched(&rays.radiance),
            marched(&rays.unshadowed),
            chain(0)?,
            chain(1)?,
            chain(2)?,
        ])
    }
}

fn grey(colours: &[f32]) -> f32 {
    colours.iter().sum::<f32>() / 3.0
}

/// A frame of the path, with one of the maps.
fn frame_desc(
    scene: &Scene,
    desc: &FlickerDesc,
    path: &Path,
    number: u32,
    index: usize,
) -> Result<FrameDesc, LabError> {
    let map = [(desc.map, 4), (desc.map, 1), (desc.truth_map, 1)][index];
    let picture = [desc.width, desc.height];
    sunlit(scene, &path.view(number), picture, map, MARGIN)
}
