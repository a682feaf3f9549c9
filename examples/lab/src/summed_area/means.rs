//! Means of many rectangles at once.

use bytemuck::{Pod, Zeroable};
use moment_shadows::{MapRegion, Source, link};
use wgpu::util::DeviceExt;

use super::SummedMap;
use crate::error::LabError;
use crate::gpu::Gpu;
use crate::pass::{Bound, Pass, Work};

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

/// Answers queries of a table.
pub struct Means<'a> {
    gpu: &'a Gpu,
    table: wgpu::TextureView,
    wgsl: String,
}

impl<'a> Means<'a> {
    /// For the table that a map has now.
    pub fn new(gpu: &'a Gpu, summed: &SummedMap) -> Result<Self, LabError> {
        let source = Source {
            name: "means.wgsl",
            text: include_str!("means.wgsl"),
        };
        Ok(Self {
            gpu,
            table: summed.table()?.create_view(&wgpu::TextureViewDescriptor {
                dimension: Some(wgpu::TextureViewDimension::D2Array),
                ..Default::default()
            }),
            wgsl: link(source, &[])?.into_wgsl(),
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
        let bound = [
            (0, Bound::Buffer(&input)),
            (1, Bound::Buffer(&output)),
            (2, Bound::Texture(self.table.clone())),
        ];
        // At most 65535.
        let work = Work::Dispatch([queries.len().div_ceil(WORKGROUP) as u32, 1]);
        let pass = Pass::new(self.gpu, "means", self.wgsl.clone(), &[], &bound, work);
        let mut encoder = device.create_command_encoder(&Default::default());
        pass.record(&mut encoder);
        self.gpu.queue.submit([encoder.finish()]);
        let bytes = self.gpu.read_buffer(&output, "means")?;
        Ok(bytemuck::pod_collect_to_vec(&bytes))
    }
}
