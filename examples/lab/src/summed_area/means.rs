//! Means of many rectangles at once.

use bytemuck::{Pod, Zeroable};
use moment_shadows::{MapRegion, Source, link};
use wgpu::util::DeviceExt;

use super::SummedMap;
use super::map::no_table;
use crate::error::LabError;
use crate::gpu::Gpu;

/// A rectangle of a table's first layer; the struct of the shader `means.wgsl`.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Query {
    /// The region that it lies in.
    pub region: MapRegion,
    /// Centre of the rectangle in texels of the layer.
    pub centre: [f32; 2],
    /// Half the extent of the rectangle in texels.
    pub half_extent: [f32; 2],
    /// The table's largest kernel.
    pub largest: [f32; 2],
    /// 0 for the plain query.
    pub interpolated: u32,
    /// The table's unit.
    pub unit: f32,
}

/// What the shader answers.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub struct Mean {
    /// The rectangle's lower corner.
    pub low: [f32; 2],
    /// The rectangle's upper corner.
    pub high: [f32; 2],
    /// The mean of its channels.
    pub mean: [f32; 4],
}

/// Invocations of a workgroup.
const WORKGROUP: usize = 64;

/// Queries of one dispatch.
const MOST: usize = 65535 * WORKGROUP;

/// A pipeline that answers queries of a table.
pub struct Means<'a> {
    gpu: &'a Gpu,
    table: wgpu::TextureView,
    pipeline: wgpu::ComputePipeline,
}

impl<'a> Means<'a> {
    /// The pipeline for the table that a map has now.
    pub fn new(gpu: &'a Gpu, summed: &SummedMap) -> Result<Self, LabError> {
        let table = summed.table().ok_or_else(no_table)?;
        let linked = link(
            Source {
                name: "means.wgsl",
                text: include_str!("means.wgsl"),
            },
            &[],
        )?;
        let module = gpu
            .device
            .create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some("summed area/means"),
                source: wgpu::ShaderSource::Wgsl(linked.into_wgsl().into()),
            });
        let pipeline = gpu
            .device
            .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some("summed area/means"),
                layout: None,
                module: &module,
                entry_point: Some("look_up"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                cache: None,
            });
        Ok(Self {
            gpu,
            table: table.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2Array),
                ..Default::default()
            }),
            pipeline,
        })
    }

    /// The answers to queries, in their order.
    pub fn run(&self, queries: &[Query]) -> Result<Vec<Mean>, LabError> {
        let mut means = Vec::with_capacity(queries.len());
        for queries in queries.chunks(MOST) {
            means.extend(self.run_some(queries)?);
        }
        Ok(means)
    }

    fn run_some(&self, queries: &[Query]) -> Result<Vec<Mean>, LabError> {
        let device = &self.gpu.device;
        let input = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("summed area/queries"),
            contents: bytemuck::cast_slice(queries),
            usage: wgpu::BufferUsages::STORAGE,
        });
        let output = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("summed area/means"),
            size: size_of::<Mean>() as u64 * queries.len() as u64,
            usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("summed area/means"),
            layout: &self.pipeline.get_bind_group_layout(0),
            entries: &[
                wgpu::BindGroupEntry {
                    binding: 0,
                    resource: input.as_entire_binding(),
                },
                wgpu::BindGroupEntry {
                    binding: 1,
                    resource: output.as_entire_binding(),
                },
                wgpu::BindGroupEntry {
                    binding: 2,
                    resource: wgpu::BindingResource::TextureView(&self.table),
                },
            ],
        });
        let mut encoder = device.create_command_encoder(&Default::default());
        {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, &group, &[]);
            // At most 65535.
            pass.dispatch_workgroups(queries.len().div_ceil(WORKGROUP) as u32, 1, 1);
        }
        self.gpu.queue.submit([encoder.finish()]);
        let bytes = self.gpu.read_buffer(&output, "means")?;
        Ok(bytemuck::pod_collect_to_vec(&bytes))
    }
}
