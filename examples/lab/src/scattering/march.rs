//! Marching, as renderers do it.

use moment_shadows::Storage;
use moment_shadows_graph::Stage;

use super::draw::{draw, linked, sampler, target, whole};
use super::stage::ScatteringStage;
use crate::compare::{Technique, unsuitable};
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;
use crate::pass::{Bound, Pass};

/// How a ray is marched.
#[derive(Debug)]
pub(super) struct Marching {
    /// Steps per ray.
    pub(super) steps: u32,
    /// Whether half as many columns and rows are marched with steps that are shifted from pixel to pixel, and the rest is
    /// interpolated bilaterally.
    pub(super) half: bool,
    /// The graph of a filtered map of four moments that rays are marched through, its output `blurred`, and the map's storage.
    pub(super) filtered: Option<(GraphFile, Storage)>,
}

/// A marcher that is bound to a stage.
pub(super) struct Marcher {
    /// What the light's map has to be made into first.
    moments: Option<GraphFrame>,
    passes: Vec<Pass>,
    radiance: wgpu::Texture,
}

impl Marcher {
    /// Through the plain depth map, or through the filtered one.
    pub(super) fn new(
        gpu: &Gpu,
        stage: &ScatteringStage,
        how: &Marching,
    ) -> Result<Self, LabError> {
        let frame = stage.plain();
        let (uniform, sampler) = (stage.uniform(gpu), sampler(gpu));
        let mut bound = vec![
            (0, Bound::Buffer(&uniform)),
            (1, whole(&frame.surface.depth)),
        ];
        let (mut moments, mut storage) = (None, String::new());
        if let Some((file, map_storage)) = &how.filtered {
            storage = format!("const STORAGE = {}u;\n", map_storage.wgsl_index());
            // Read by bindings that outlive this call; its contents are made whenever it is recorded.
            let graph = GraphFrame::in_air(gpu, stage.frame(), file, Some(&stage.air))?;
            let map = (graph.bindings.output("blurred"))
                .ok_or_else(|| unsuitable(&file.name, "it has no output 'blurred'".to_owned()))?;
            let map = map.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2Array),
                ..Default::default()
            });
            bound.extend([(2, Bound::Texture(map)), (3, Bound::Sampler(&sampler))]);
            moments = Some(graph);
        } else {
            bound.push((2, whole(&frame.light_map.texture)));
        }
        let visibility = match moments {
            Some(_) => include_str!("visibility_moments.wgsl"),
            None => include_str!("visibility_depth.wgsl"),
        };
        let generated = [
            ("scattering_visibility", visibility),
            ("scattering_storage", storage.as_str()),
        ];
        let wgsl = linked("march.wgsl", include_str!("march.wgsl"), &generated)?;
        let picture = frame.desc.picture;
        let radiance = target(gpu, "march/radiance", picture);
        let mut constants = vec![("STEPS", f64::from(how.steps))];
        let passes = if how.half {
            constants.extend([("PIXELS", 2.0), ("DITHERED", 1.0)]);
            let half = picture.map(|side| side.div_ceil(2));
            let half = target(gpu, "march/half radiance", half);
            let march = draw(gpu, wgsl, &constants, &bound, &half);
            let wgsl = linked("upsample.wgsl", include_str!("upsample.wgsl"), &[])?;
            bound.truncate(2);
            bound.push((2, whole(&half)));
            vec![march, draw(gpu, wgsl, &[], &bound, &radiance)]
        } else {
            vec![draw(gpu, wgsl, &constants, &bound, &radiance)]
        };
        gpu.check()?;
        Ok(Self {
            moments,
            passes,
            radiance,
        })
    }
}

impl Technique for Marcher {
    fn works_in(&self, stage: Stage) -> bool {
        stage == Stage::AfterMainPass || self.moments.is_some()
    }

    fn record(&self, stage: Stage, encoder: &mut wgpu::CommandEncoder) -> Result<(), LabError> {
        match (stage, &self.moments) {
            (Stage::AfterShadowMaps, Some(graph)) => Technique::record(graph, stage, encoder)?,
            (Stage::AfterShadowMaps, None) => {}
            (Stage::AfterMainPass, _) => self.passes.iter().for_each(|pass| pass.record(encoder)),
        }
        Ok(())
    }

    fn output(&self) -> Result<&wgpu::Texture, LabError> {
        Ok(&self.radiance)
    }
}
