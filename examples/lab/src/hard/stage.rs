//! A scene under a sun, drawn, with the truth of the filter that all candidates approximate.

use moment_shadows::TextureFormat;
use moment_shadows_graph::{Capabilities, TextureDesc};

use super::candidate::{HardCandidate, graph};
use super::report::HardErrors;
use crate::command::drawn::Drawn;
use crate::command::render::RenderOptions;
use crate::compare::{Shown, Stage, Technique};
use crate::error::LabError;
use crate::frame::{Frame, FrameDesc};
use crate::gpu::Gpu;
use crate::graph_frame::{GraphFrame, imports, read_intensity};
use crate::judgement::Truth;
use crate::picture::signed_difference;
use crate::scene::Scene;
use crate::texture::upload;

/// A difference of shadow intensity that is shown in full colour.
const FULL_DIFFERENCE: f32 = 0.5;

/// A drawn scene with its truth.
pub struct HardStage {
    truth: Truth,
    scene: String,
    drawn: Drawn,
    capabilities: Capabilities,
    /// Frames with several samples per texel, and with one.
    frames: [Frame; 2],
}

impl HardStage {
    /// Draws the scene and computes the truth.
    pub fn new(gpu: &Gpu, scene: &Scene, drawn: Drawn) -> Result<Self, LabError> {
        let file = &graph()?;
        let frames = RenderOptions::default().frames(gpu, scene, &drawn, file.radius()?)?;
        Ok(Self {
            truth: Truth::of(gpu, &frames[0], file)?,
            scene: scene.name.clone(),
            drawn,
            capabilities: Capabilities::of_device(&gpu.adapter, &gpu.device),
            frames,
        })
    }

    /// Several samples per texel where a technique can have them.
    fn frame(&self, candidate: &HardCandidate) -> &Frame {
        &self.frames[usize::from(candidate.file.reads_depth())]
    }
}

impl Stage for HardStage {
    type Candidate = HardCandidate;
    type Picture = Vec<f32>;
    type Errors = HardErrors;

    fn name(candidate: &HardCandidate) -> &str {
        &candidate.name
    }

    fn bind(&self, gpu: &Gpu, candidate: &HardCandidate) -> Result<Box<dyn Technique>, LabError> {
        let frame = self.frame(candidate);
        Ok(Box::new(GraphFrame::new(gpu, frame, &candidate.file)?))
    }

    fn read(&self, gpu: &Gpu, output: &wgpu::Texture) -> Result<Vec<f32>, LabError> {
        read_intensity(gpu, output)
    }

    fn errors(&self, candidate: &HardCandidate, shadow: &Vec<f32>) -> Result<HardErrors, LabError> {
        let file = &candidate.file;
        let plan = file
            .graph
            .compile(&self.capabilities, &imports(&self.frame(candidate).desc)?)
            .map_err(LabError::graph(&file.name))?;
        Ok(HardErrors {
            error: self.truth.judge(shadow)?.error,
            bytes_resident: plan.bytes_resident(),
            bytes_moved: plan.bytes_moved(),
        })
    }

    fn show(&self, gpu: &Gpu, pictures: &[Vec<f32>]) -> Result<Shown, LabError> {
        let desc = TextureDesc::new(TextureFormat::R32Float, self.desc().picture);
        let lit = |shadow: &[f32]| {
            let texture = upload(gpu, &desc, bytemuck::cast_slice(shadow));
            self.frames[0].picture(gpu, &texture)
        };
        let truth = &self.truth.truth;
        let shown = |shadow: &Vec<f32>| {
            let difference = signed_difference(shadow, truth, FULL_DIFFERENCE);
            Ok([lit(shadow)?, difference])
        };
        Ok(Shown {
            truth: lit(truth)?,
            pictures: pictures
                .iter()
                .map(shown)
                .collect::<Result<_, LabError>>()?,
        })
    }

    fn setting(&self) -> String {
        format!("{}: {}; truth", self.scene, self.drawn)
    }

    fn stem(&self) -> String {
        format!("{}-hard", self.scene)
    }

    fn desc(&self) -> &FrameDesc {
        &self.frames[0].desc
    }
}
