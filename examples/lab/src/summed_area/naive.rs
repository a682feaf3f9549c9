//! The usual way to make a summed-area table: a row, then a column, per invocation. What ours is compared with.

use moment_shadows::{ShaderError, Source, TextureFormat, link};
use moment_shadows_graph::TextureDesc;

use super::map::moments_texture;
use crate::error::LabError;
use crate::gpu::Gpu;

/// Both halves by name, text and entry point.
pub const SHADERS: [(&str, &str, &str); 2] = [
    ("naive rows", include_str!("naive_rows.wgsl"), "sum_rows"),
    (
        "naive columns",
        include_str!("naive_columns.wgsl"),
        "sum_columns",
    ),
];

/// Lines of a workgroup.
pub const LINES: u32 = 64;

/// The linked text of one of [`SHADERS`].
pub fn linked(name: &str, text: &str) -> Result<String, ShaderError> {
    Ok(link(Source { name, text }, &[])?.into_wgsl())
}

/// The table of a unorm16 map with one layer.
pub struct NaiveTable {
    size: [u32; 2],
    passes: Vec<(wgpu::ComputePipeline, wgpu::BindGroup)>,
    table: wgpu::Texture,
}

impl NaiveTable {
    /// The table of a map with these bytes.
    pub fn new(gpu: &Gpu, desc: &TextureDesc, bytes: &[u8]) -> Result<Self, LabError> {
        let moments = moments_texture(gpu, desc, bytes);
        let texture = |label| {
            gpu.device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size: moments.size(),
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: wgpu::TextureFormat::Rgba32Uint,
                usage: wgpu::TextureUsages::STORAGE_BINDING
                    | wgpu::TextureUsages::TEXTURE_BINDING
                    | wgpu::TextureUsages::COPY_SRC,
                view_formats: &[],
            })
        };
        let rows = texture("naive/rows");
        let table = texture("naive/table");
        let passes = SHADERS
            .iter()
            .zip([[&moments, &rows], [&rows, &table]])
            .map(|((name, text, entry_point), textures)| {
                pass(gpu, name, &linked(name, text)?, entry_point, textures)
            })
            .collect::<Result<_, LabError>>()?;
        Ok(Self {
            size: desc.size,
            passes,
            table,
        })
    }

    /// Records both halves.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder) {
        for ((pipeline, group), lines) in self.passes.iter().zip([self.size[1], self.size[0]]) {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, group, &[]);
            pass.dispatch_workgroups(lines.div_ceil(LINES), 1, 1);
        }
    }

    /// Makes the table and reads its integers.
    pub fn run(&self, gpu: &Gpu) -> Result<Vec<u32>, LabError> {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.record(&mut encoder);
        gpu.queue.submit([encoder.finish()]);
        let bytes = gpu.read_texture(&self.table, 0, "naive table")?;
        Ok(bytemuck::pod_collect_to_vec(&bytes))
    }

    /// Bytes that both halves read and write per texel of unorm16.
    #[must_use]
    pub fn bytes_per_texel() -> [u32; 2] {
        let sums = TextureFormat::Rgba32Uint.bytes_per_texel();
        [
            TextureFormat::Rgba16Unorm.bytes_per_texel() + sums,
            2 * sums,
        ]
    }
}

fn pass(
    gpu: &Gpu,
    label: &str,
    wgsl: &str,
    entry_point: &str,
    textures: [&wgpu::Texture; 2],
) -> Result<(wgpu::ComputePipeline, wgpu::BindGroup), LabError> {
    let module = gpu
        .device
        .create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(label),
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        });
    let pipeline = gpu
        .device
        .create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(label),
            layout: None,
            module: &module,
            entry_point: Some(entry_point),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            cache: None,
        });
    let views = textures.map(|texture| texture.create_view(&Default::default()));
    let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some(label),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[0, 1].map(|binding| wgpu::BindGroupEntry {
            binding,
            resource: wgpu::BindingResource::TextureView(&views[binding as usize]),
        }),
    });
    gpu.check()?;
    Ok((pipeline, group))
}
