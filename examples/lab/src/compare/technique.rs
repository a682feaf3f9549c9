//! What is timed and read of a technique that is bound to a stage.

use moment_shadows_graph::Stage;
use moment_shadows_graph::record::Recording;

use crate::error::LabError;
use crate::gpu::Gpu;
use crate::graph_frame::GraphFrame;

/// A technique, bound to what it reads.
pub trait Technique {
    /// Whether it does anything in a stage: to the light's map, or to pixels.
    fn works_in(&self, stage: Stage) -> bool;

    /// Records what it does in a stage.
    fn record(&self, stage: Stage, encoder: &mut wgpu::CommandEncoder) -> Result<(), LabError>;

    /// The texture that it draws.
    fn output(&self) -> Result<&wgpu::Texture, LabError>;

    /// Records everything and submits it.
    fn run(&self, gpu: &Gpu) -> Result<(), LabError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for stage in Stage::ALL {
            self.record(stage, &mut encoder)?;
        }
        gpu.queue.submit([encoder.finish()]);
        gpu.check()
    }
}

impl Technique for GraphFrame {
    fn works_in(&self, stage: Stage) -> bool {
        self.plan.passes.iter().any(|pass| pass.stage == stage)
    }

    fn record(&self, stage: Stage, encoder: &mut wgpu::CommandEncoder) -> Result<(), LabError> {
        Ok(self.bindings.record(stage, encoder, Recording::default())?)
    }

    fn output(&self) -> Result<&wgpu::Texture, LabError> {
        let names = ["shadow_intensity", "scattering"];
        let output = names.iter().find_map(|name| self.bindings.output(name));
        output.ok_or_else(|| {
            LabError::unsuitable("a graph", format!("it has no output '{}'", names[0]))
        })
    }

    fn run(&self, gpu: &Gpu) -> Result<(), LabError> {
        GraphFrame::run(self, gpu)
    }
}
