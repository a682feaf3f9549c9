//! The usual way to make a summed-area table: a row, then a column, per invocation. What ours is compared with.

use moment_shadows::{ShaderError, Source, TextureFormat, link};
use moment_shadows_graph::TextureDesc;

use crate::error::LabError;
use crate::gpu::Gpu;
use crate::pass::{Bound, Pass, Work};
use crate::texture::{texture, upload};

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
    passes: Vec<Pass>,
    table: wgpu::Texture,
}

impl NaiveTable {
    /// The table of a map with these bytes.
    pub fn new(gpu: &Gpu, desc: &TextureDesc, bytes: &[u8]) -> Result<Self, LabError> {
        let sums = TextureDesc::new(TextureFormat::Rgba32Uint, desc.size);
        let usage = wgpu::TextureUsages::STORAGE_BINDING
            | wgpu::TextureUsages::TEXTURE_BINDING
            | wgpu::TextureUsages::COPY_SRC;
        let [rows, table] =
            ["naive/rows", "naive/table"].map(|label| texture(gpu, label, &sums, usage));
        let moments = upload(gpu, desc, bytes);
        let view =
            |texture: &wgpu::Texture| Bound::Texture(texture.create_view(&Default::default()));
        let steps = [
            (&moments, &rows, desc.size[1]),
            (&rows, &table, desc.size[0]),
        ];
        let mut passes = Vec::new();
        for ((name, text, _), (from, to, lines)) in SHADERS.into_iter().zip(steps) {
            let bound = [(0, view(from)), (1, view(to))];
            let work = Work::Dispatch([lines.div_ceil(LINES), 1]);
            passes.push(Pass::new(gpu, name, linked(name, text)?, &[], &bound, work));
        }
        gpu.check()?;
        Ok(Self { passes, table })
    }

    /// Records both halves.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder) {
        self.passes.iter().for_each(|pass| pass.record(encoder));
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
