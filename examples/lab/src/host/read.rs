//! Back to the processor: what truths are computed from.

use half::f16;

use super::Surface;
use super::error::created;
use crate::error::LabError;
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
pub fn read_depth_samples(gpu: &Gpu, depth: &wgpu::Texture) -> Result<DepthSamples, LabError> {
    let [width, height, samples] = [depth.width(), depth.height(), depth.sample_count()];
    let row_bytes = u64::from(width) * u64::from(samples) * 4;
    // Rows are also workgroups along y, of which there are at most 65,535.
    let rows = (BAND_BYTES / row_bytes).clamp(1, u64::from(height.min(65_535))) as u32;
    let text = include_str!("read_depth.wgsl");
    let text = match samples {
        1 => text.replace("texture_depth_multisampled_2d", "texture_depth_2d"),
        _ => text.to_owned(),
    };
    let label = "host/depth samples";
    let pipeline = created(gpu, "the depth reader", || {
        gpu.compute(label, &text, "copy_band")
    })?;
    let view = depth.create_view(&wgpu::TextureViewDescriptor {
        aspect: wgpu::TextureAspect::DepthOnly,
        ..Default::default()
    });
    let mut values = Vec::with_capacity((row_bytes / 4) as usize * height as usize);
    for first_row in (0..height).step_by(rows as usize) {
        let band = rows.min(height - first_row);
        let buffer = created(gpu, "the depth reader's buffer", || {
            let buffer = gpu.output(label, row_bytes * u64::from(band));
            let contents = [first_row, samples, 0, 0];
            let usage = wgpu::BufferUsages::UNIFORM;
            let uniform = gpu.filled(label, bytemuck::bytes_of(&contents), usage);
            let bound = [
                wgpu::BindingResource::TextureView(&view),
                buffer.as_entire_binding(),
                uniform.as_entire_binding(),
            ];
            let group = gpu.bind(&pipeline.get_bind_group_layout(0), bound);
            gpu.dispatch(&pipeline, &[&group], [width.div_ceil(64), band]);
            buffer
        })?;
        values.extend(floats(&gpu.read_buffer(&buffer, "depth samples")?));
    }
    Ok(DepthSamples {
        width,
        height,
        samples,
        values,
    })
}

/// Reads positions and normals of a G-buffer.
pub fn read_gbuffer(gpu: &Gpu, surface: &Surface) -> Result<SurfacePixels, LabError> {
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
