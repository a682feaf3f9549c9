//! The host's pass that takes a picture.

use moment_shadows_graph::ResourceDesc;
use nightshade_renderer::rendergraph::{self, PassExecutionContext, PassNode, SubGraphRunCommand};

use crate::adapter::Inputs;
use crate::error::HostError;
use crate::gpu::Gpu;

#[derive(Clone)]
pub(super) struct Take {
    name: String,
    /// Bytes of a row of texels, and those that a copy takes.
    row: u32,
    padded: u32,
    pub(super) buffer: wgpu::Buffer,
}

impl Take {
    pub(super) fn new(gpu: &Gpu, output: String, of: &ResourceDesc) -> Result<Self, HostError> {
        let Some(of) = of.texture() else {
            return Err(HostError::Device(format!(
                "output '{output}' is no picture"
            )));
        };
        let row = of.size[0] * of.format.bytes_per_texel();
        let padded = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(&output),
            size: u64::from(padded) * u64::from(of.size[1]) * u64::from(of.array_layers()),
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        Ok(Self {
            name: format!("take {output}"),
            row,
            padded,
            buffer,
        })
    }

    /// The texels without what fills up the rows.
    pub(super) fn texels(&self, bytes: &[u8]) -> Vec<u8> {
        let rows = bytes.chunks_exact(self.padded as usize);
        rows.flat_map(|row| &row[..self.row as usize])
            .copied()
            .collect()
    }
}

impl PassNode<Inputs> for Take {
    fn name(&self) -> &str {
        &self.name
    }

    fn reads(&self) -> Vec<&str> {
        vec!["picture"]
    }

    fn writes(&self) -> Vec<&str> {
        Vec::new()
    }

    fn execute<'r, 'e>(
        &mut self,
        context: PassExecutionContext<'r, 'e, Inputs>,
    ) -> rendergraph::Result<Vec<SubGraphRunCommand<'r>>> {
        let texture = context.get_texture("picture")?;
        let into = wgpu::TexelCopyBufferInfo {
            buffer: &self.buffer,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(self.padded),
                rows_per_image: Some(texture.height()),
            },
        };
        context
            .encoder
            .copy_texture_to_buffer(texture.as_image_copy(), into, texture.size());
        Ok(Vec::new())
    }
}
