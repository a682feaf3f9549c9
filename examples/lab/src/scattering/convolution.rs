//! The rectified convolution shadow map of Klehm et al., "Prefiltered single scattering", i3D 2014: 256 bits per texel.

use moment_shadows_graph::Stage;

use super::draw::{Bound, Draw, RADIANCE, group, linked, sampler, target};
use super::stage::ScatteringStage;
use crate::compare::Technique;
use crate::error::LabError;
use crate::gpu::Gpu;

/// Planes of four channels: eight terms.
const PLANES: u32 = 4;

/// Rows of a workgroup.
const ROWS: u32 = 64;

/// The map that is bound to a stage, and what reads it.
pub(super) struct ConvolutionRows {
    sum: wgpu::ComputePipeline,
    group: wgpu::BindGroup,
    rows: u32,
    composite: Draw,
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
        let map = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("convolution/rows"),
            size: wgpu::Extent3d {
                width: extent[0],
                height: extent[1],
                depth_or_array_layers: PLANES,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: RADIANCE,
            usage: wgpu::TextureUsages::STORAGE_BINDING | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let uniform = stage.uniform(gpu);
        let depth =
            |texture: &wgpu::Texture| Bound::Texture(texture.create_view(&Default::default()));
        let wgsl = linked(
            "convolution_rows.wgsl",
            include_str!("convolution_rows.wgsl"),
            &[],
        )?;
        let module = gpu
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("convolution/rows"),
                source: wgpu::ShaderSource::Wgsl(wgsl.into()),
            });
        let sum = gpu
            .device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("convolution/rows"),
                layout: None,
                module: &module,
                entry_point: Some("sum_rows"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            });
        // Only what the entry point uses is in its layout: not the camera's depth.
        let entries = [
            (0, Bound::Uniform(&uniform)),
            (2, depth(&frame.light_map.texture)),
            (3, Bound::Texture(map.create_view(&Default::default()))),
        ];
        let group_of_rows = group(
            gpu,
            "convolution/rows",
            &sum.get_bind_group_layout(0),
            &entries,
        );
        let wgsl = linked(
            "convolution_radiance.wgsl",
            include_str!("convolution_radiance.wgsl"),
            &[],
        )?;
        let radiance = target(gpu, "convolution/radiance", frame.desc.picture);
        let sampler = sampler(gpu);
        let bound = [
            (0, Bound::Uniform(&uniform)),
            (1, depth(&frame.surface.depth)),
            (2, Bound::Texture(map.create_view(&Default::default()))),
            (3, Bound::Sampler(&sampler)),
        ];
        let composite = Draw::new(gpu, "convolution/radiance", wgsl, &[], &bound, &radiance)?;
        Ok(Self {
            sum,
            group: group_of_rows,
            rows: extent[1],
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
            Stage::AfterShadowMaps => {
                let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                    label: Some("convolution/rows"),
                    timestamp_writes: None,
                });
                pass.set_pipeline(&self.sum);
                pass.set_bind_group(0, &self.group, &[]);
                pass.dispatch_workgroups(self.rows.div_ceil(ROWS), 1, 1);
            }
            Stage::AfterMainPass => self.composite.record(encoder),
        }
        Ok(())
    }

    fn output(&self) -> Result<&wgpu::Texture, LabError> {
        Ok(&self.radiance)
    }
}
