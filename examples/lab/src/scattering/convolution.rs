//! The rectified convolution shadow map of Klehm et al., "Prefiltered single scattering", i3D 2014: 256 bits per texel.

use moment_shadows_graph::{Stage, TextureDesc};

use super::draw::{RADIANCE, draw, linked, sampler, target, whole};
use super::stage::ScatteringStage;
use crate::compare::Technique;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::pass::{Bound, Pass, Work};
use crate::texture::texture;

/// Planes of four channels: eight terms.
const PLANES: u32 = 4;

/// Rows of a workgroup.
const ROWS: u32 = 64;

/// The map that is bound to a stage, and what reads it.
pub(super) struct ConvolutionRows {
    sum: Pass,
    composite: Pass,
    radiance: wgpu::Texture,
}

impl ConvolutionRows {
    /// The technique with columns and rows of the rectified map.
    pub(super) fn new(
        gpu: &Gpu,
        stage: &ScatteringStage,
        extent: [u32; 2],
    ) -> Result<Self, LabError> {
        let frame = stage.plain();
        let desc = TextureDesc {
            layers: PLANES,
            ..TextureDesc::new(RADIANCE, extent)
        };
        let usage = wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::TEXTURE_BINDING;
        let map = texture(gpu, "convolution/rows", &desc, usage);
        let (uniform, sampler) = (stage.uniform(gpu), sampler(gpu));
        let wgsl = include_str!("convolution_rows.wgsl");
        let wgsl = linked("convolution_rows.wgsl", wgsl)?;
        // Only what the entry point uses is in its layout: not the camera's depth.
        let bound = [
            (0, Bound::Buffer(&uniform)),
            (2, whole(&frame.light_map.texture)),
            (3, whole(&map)),
        ];
        let work = Work::Dispatch([extent[1].div_ceil(ROWS), 1]);
        let sum = Pass::new(gpu, "convolution/rows", wgsl, &[], &bound, work);
        let wgsl = include_str!("convolution_radiance.wgsl");
        let wgsl = linked("convolution_radiance.wgsl", wgsl)?;
        let radiance = target(gpu, "convolution/radiance", frame.desc.picture);
        let bound = [
            (0, Bound::Buffer(&uniform)),
            (1, whole(&frame.surface.depth)),
            (2, whole(&map)),
            (3, Bound::Sampler(&sampler)),
        ];
        let composite = draw(gpu, wgsl, &[], &bound, &radiance);
        gpu.check()?;
        Ok(Self {
            sum,
            composite,
            radiance,
        })
    }
}

impl Technique for ConvolutionRows {
    fn works_in(&self, _: Stage) -> bool {
        true
    }

    fn record(&self, stage: Stage, encoder: &mut wgpu::CommandEncoder) -> Result<(), LabError> {
        match stage {
            Stage::AfterShadowMaps => self.sum.record(encoder),
            Stage::AfterMainPass => self.composite.record(encoder),
        }
        Ok(())
    }

    fn output(&self) -> Result<&wgpu::Texture, LabError> {
        Ok(&self.radiance)
    }
}
