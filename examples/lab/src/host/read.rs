//! Back to the processor: what truths are computed from.

use half::f16;
use wgpu::util::DeviceExt;

use super::error::created;
use super::{HostError, Surface, UNIFORM, binding, texture_type};
use crate::gpu::Gpu;

/// A depth map as it was stored, every sample of it.
#[derive(Clone, Debug, PartialEq)]
pub struct DepthSamples {
    /// Texels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Samples per texel.
    pub samples: u32,
    /// Stored depth, raw: sample `s` of texel (x, y) is at `(y * width + x) * samples + s`, the top row first.
    pub values: Vec<f32>,
}

/// What the camera sees, per pixel, the top row first.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfacePixels {
    /// Pixels per row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// World positions; zero where nothing is seen.
    pub position: Vec<[f32; 3]>,
    /// Unit normals of the triangles, on the side that is seen, rounded to float16 per component; zero where nothing
    /// is seen.
    pub normal: Vec<[f32; 3]>,
    /// Whether something is seen.
    pub covered: Vec<bool>,
}

/// Buffers are at most this large, well under what every device binds (128 MiB).
const BAND_BYTES: u64 = 64 << 20;

/// Reads all samples of a depth texture (usage `TEXTURE_BINDING`), as the values that a shader sees.
pub fn read_depth_samples(gpu: &Gpu, depth: &wgpu::Texture) -> Result<DepthSamples, HostError> {
    let [width, height, samples] = [depth.width(), depth.height(), depth.sample_count()];
    let row_bytes = u64::from(width) * u64::from(samples) * 4;
    // Rows are also workgroups along y, of which there are at most 65,535.
    let rows = (BAND_BYTES / row_bytes).clamp(1, u64::from(height.min(65_535))) as u32;
    let (layout, pipeline) = created(gpu, "the depth reader", || reader(gpu, samples))?;
    let mut values = Vec::with_capacity((row_bytes / 4) as usize * height as usize);
    let mut first_row = 0;
    while first_row < height {
        let band = rows.min(height - first_row);
        let buffer = created(gpu, "the depth reader's buffer", || {
            let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("host/depth samples"),
                size: row_bytes * u64::from(rows),
                usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
                mapped_at_creation: false,
            });
            run(gpu, &layout, &pipeline, depth, &buffer, first_row, band);
            buffer
        })?;
        let bytes = gpu.read_buffer(&buffer, "depth samples")?;
        let wanted = (row_bytes * u64::from(band)) as usize;
        values.extend(floats(&bytes[..wanted]));
        first_row += band;
    }
    Ok(DepthSamples {
        width,
        height,
        samples,
        values,
    })
}

/// The layout and pipeline that read a texture of `samples` samples.
fn reader(gpu: &Gpu, samples: u32) -> (wgpu::BindGroupLayout, wgpu::ComputePipeline) {
    let compute = wgpu::ShaderStages::COMPUTE;
    let source = if samples == 1 {
        wgpu::include_wgsl!("read_depth.wgsl")
    } else {
        wgpu::include_wgsl!("read_depth_samples.wgsl")
    };
    let storage = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Storage { read_only: false },
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let layout = gpu
        .device
        .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("host/depth samples"),
            entries: &[
                binding(
                    0,
                    compute,
                    texture_type(wgpu::TextureSampleType::Depth, samples > 1),
                ),
                binding(1, compute, storage),
                binding(2, compute, UNIFORM),
            ],
        });
    let pipeline_layout = gpu
        .device
        .create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("host/depth samples"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
    let module = gpu.device.create_shader_module(source);
    let pipeline = gpu
        .device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some("host/depth samples"),
            layout: Some(&pipeline_layout),
            module: &module,
            entry_point: Some("read"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
    (layout, pipeline)
}

/// Copies `rows` rows from `first_row` into `buffer`.
fn run(
    gpu: &Gpu,
    layout: &wgpu::BindGroupLayout,
    pipeline: &wgpu::ComputePipeline,
    depth: &wgpu::Texture,
    buffer: &wgpu::Buffer,
    first_row: u32,
    rows: u32,
) {
    let view = depth.create_view(&wgpu::TextureViewDescriptor {
        aspect: wgpu::TextureAspect::DepthOnly,
        ..Default::default()
    });
    let uniform = gpu
        .device
        .create_buffer_init(&wgpu::util::BufferInitDescriptor {
            label: Some("host/depth band"),
            contents: bytemuck::bytes_of(&[first_row, 0, 0, 0]),
            usage: wgpu::BufferUsages::UNIFORM,
        });
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("host/depth samples"),
        layout,
        entries: &[
            wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::TextureView(&view),
            },
            wgpu::BindGroupEntry {
                binding: 1,
                resource: buffer.as_entire_binding(),
            },
            wgpu::BindGroupEntry {
                binding: 2,
                resource: uniform.as_entire_binding(),
            },
        ],
    });
    let mut encoder = gpu
        .device
        .create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
        label: Some("host/depth samples"),
        timestamp_writes: None,
    });
    pass.set_pipeline(pipeline);
    pass.set_bind_group(0, &group, &[]);
    pass.dispatch_workgroups(depth.width().div_ceil(64), rows, 1);
    drop(pass);
    gpu.queue.submit([encoder.finish()]);
}

/// Reads positions and normals of a G-buffer.
pub fn read_gbuffer(gpu: &Gpu, surface: &Surface) -> Result<SurfacePixels, HostError> {
    let positions = gpu.read_texture(&surface.position, 0, "surface positions")?;
    let normals = gpu.read_texture(&surface.normal, 0, "surface normals")?;
    let positions: Vec<f32> = floats(&positions).collect();
    let normals: Vec<f32> = normals
        .chunks_exact(2)
        .map(|bytes| f16::from_le_bytes([bytes[0], bytes[1]]).to_f32())
        .collect();
    let firsts = |values: &[f32]| -> Vec<[f32; 3]> {
        values
            .chunks_exact(4)
            .map(|value| [value[0], value[1], value[2]])
            .collect()
    };
    Ok(SurfacePixels {
        width: surface.size[0],
        height: surface.size[1],
        position: firsts(&positions),
        normal: firsts(&normals),
        covered: positions
            .chunks_exact(4)
            .map(|value| value[3] > 0.0)
            .collect(),
    })
}

/// Little-endian floats.
fn floats(bytes: &[u8]) -> impl Iterator<Item = f32> + '_ {
    bytes
        .chunks_exact(4)
        .map(|bytes| f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]))
}
