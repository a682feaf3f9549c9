//! Marching, as renderers do it.

use moment_shadows::Storage;

use super::draw::{Bound, Draw, linked, sampler, target};
use super::stage::ScatteringStage;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::graph_file::GraphFile;
use crate::graph_frame::GraphFrame;

/// How a ray is marched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Marching {
    /// Steps per ray.
    pub(super) steps: u32,
    /// Whether half as many columns and rows are marched, and the rest is interpolated bilaterally.
    pub(super) half: bool,
    /// Whether steps are shifted from pixel to pixel.
    pub(super) dithered: bool,
}

/// A marcher that is bound to a stage.
pub(super) struct Marcher {
    /// What the light's map has to be made into first.
    moments: Option<GraphFrame>,
    passes: Vec<Draw>,
    radiance: wgpu::Texture,
}

impl Marcher {
    /// Through the plain depth map.
    pub(super) fn new(gpu: &Gpu, stage: &ScatteringStage, how: Marching) -> Result<Self, LabError> {
        let frame = stage.plain();
        let uniform = stage.uniform(gpu);
        let camera_depth = || Bound::Texture(frame.surface.depth.create_view(&Default::default()));
        let light_depth = Bound::Texture(frame.light_map.texture.create_view(&Default::default()));
        let wgsl = linked(
            "march.wgsl",
            include_str!("march.wgsl"),
            &[(
                "scattering_visibility",
                include_str!("visibility_depth.wgsl"),
            )],
        )?;
        let picture = frame.desc.picture;
        let radiance = target(gpu, "march/radiance", picture);
        let marched = if how.half {
            let size = picture.map(|side| side.div_ceil(2));
            &target(gpu, "march/half radiance", size)
        } else {
            &radiance
        };
        let constants = [
            ("STEPS", f64::from(how.steps)),
            ("PIXELS", if how.half { 2.0 } else { 1.0 }),
            ("DITHERED", f64::from(u8::from(how.dithered))),
        ];
        let bound = [
            (0, Bound::Uniform(&uniform)),
            (1, camera_depth()),
            (2, light_depth),
        ];
        let mut passes = vec![Draw::new(gpu, "march", wgsl, &constants, &bound, marched)?];
        if how.half {
            let wgsl = linked("upsample.wgsl", include_str!("upsample.wgsl"), &[])?;
            let half = Bound::Texture(marched.create_view(&Default::default()));
            let bound = [
                (0, Bound::Uniform(&uniform)),
                (1, camera_depth()),
                (2, half),
            ];
            passes.push(Draw::new(gpu, "upsample", wgsl, &[], &bound, &radiance)?);
        }
        Ok(Self {
            moments: None,
            passes,
            radiance,
        })
    }

    /// At full resolution through the filtered map of four moments that a graph makes of the light's depth, its output
    /// `moments`.
    pub(super) fn through_moments(
        gpu: &Gpu,
        stage: &ScatteringStage,
        steps: u32,
        file: &GraphFile,
        storage: Storage,
    ) -> Result<Self, LabError> {
        let graph = GraphFrame::in_air(gpu, stage.frame(), file, Some(&stage.air))?;
        // Read by bindings that outlive this call; its contents are made whenever it is recorded.
        let map = graph
            .bindings
            .output("map")
            .ok_or_else(|| LabError::Unsuitable {
                file: file.name.clone(),
                reason: "it has no output 'moments'".to_owned(),
            })?;
        let map = map.create_view(&wgpu::TextureViewDescriptor {
            dimension: Some(wgpu::TextureViewDimension::D2Array),
            ..Default::default()
        });
        let storage = format!("const STORAGE = {}u;\n", storage.wgsl_index());
        let wgsl = linked(
            "march.wgsl",
            include_str!("march.wgsl"),
            &[
                ("scattering_storage", &storage),
                (
                    "scattering_visibility",
                    include_str!("visibility_moments.wgsl"),
                ),
            ],
        )?;
        let frame = stage.frame();
        let radiance = target(gpu, "march/radiance", frame.desc.picture);
        let uniform = stage.uniform(gpu);
        let sampler = sampler(gpu);
        let bound = [
            (0, Bound::Uniform(&uniform)),
            (
                1,
                Bound::Texture(frame.surface.depth.create_view(&Default::default())),
            ),
            (2, Bound::Texture(map)),
            (3, Bound::Sampler(&sampler)),
        ];
        let constants = [("STEPS", f64::from(steps))];
        let pass = Draw::new(gpu, "march moments", wgsl, &constants, &bound, &radiance)?;
        Ok(Self {
            moments: Some(graph),
            passes: vec![pass],
            radiance,
        })
    }

    /// What the light's map has to be made into first.
    pub(super) fn moments(&self) -> Option<&GraphFrame> {
        self.moments.as_ref()
    }

    /// Records all that is done per pixel.
    pub(super) fn record_pixels(&self, encoder: &mut wgpu::CommandEncoder) {
        for pass in &self.passes {
            pass.record(encoder);
        }
    }

    /// The radiance.
    pub(super) fn radiance(&self) -> &wgpu::Texture {
        &self.radiance
    }
}
