//! Marching, as renderers do it.

use moment_shadows_graph::Stage;

use super::draw::{draw, linked, target, whole};
use super::stage::ScatteringStage;
use crate::compare::Technique;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::pass::{Bound, Pass};

/// A marcher that is bound to a stage.
pub(super) struct Marcher {
    passes: Vec<Pass>,
    radiance: wgpu::Texture,
}

impl Marcher {
    /// Through the plain depth map; at half of the resolution, or at all of it.
    pub(super) fn new(
        gpu: &Gpu,
        stage: &ScatteringStage,
        steps: u32,
        half: bool,
    ) -> Result<Self, LabError> {
        let frame = stage.plain();
        let uniform = stage.uniform(gpu);
        let mut bound = vec![
            (0, Bound::Buffer(&uniform)),
            (1, whole(&frame.surface.depth)),
            (2, whole(&frame.light_map.texture)),
        ];
        let wgsl = linked("march.wgsl", include_str!("march.wgsl"))?;
        let picture = frame.desc.picture;
        let radiance = target(gpu, "march/radiance", picture);
        let mut constants = vec![("STEPS", f64::from(steps))];
        let passes = if half {
            constants.extend([("PIXELS", 2.0), ("DITHERED", 1.0)]);
            let half = picture.map(|side| side.div_ceil(2));
            let half = target(gpu, "march/half radiance", half);
            let march = draw(gpu, wgsl, &constants, &bound, &half);
            let wgsl = linked("upsample.wgsl", include_str!("upsample.wgsl"))?;
            bound.truncate(2);
            bound.push((2, whole(&half)));
            vec![march, draw(gpu, wgsl, &[], &bound, &radiance)]
        } else {
            vec![draw(gpu, wgsl, &constants, &bound, &radiance)]
        };
        gpu.check()?;
        Ok(Self { passes, radiance })
    }
}

impl Technique for Marcher {
    fn works_in(&self, stage: Stage) -> bool {
        stage == Stage::AfterMainPass
    }

    fn record(&self, stage: Stage, encoder: &mut wgpu::CommandEncoder) -> Result<(), LabError> {
        match stage {
            Stage::AfterShadowMaps => {}
            Stage::AfterMainPass => self.passes.iter().for_each(|pass| pass.record(encoder)),
        }
        Ok(())
    }

    fn output(&self) -> Result<&wgpu::Texture, LabError> {
        Ok(&self.radiance)
    }
}
