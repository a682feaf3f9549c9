//! The difference of two pictures.

use half::f16;
use moment_shadows_graph::TextureDesc;

use crate::error::RecorderError;

type TextureFormat = wgpu::TextureFormat;

/// What two pictures hold.
pub(crate) struct Seen {
    pub(crate) values: usize,
    /// The least and the largest value.
    pub(crate) range: [f32; 2],
    pub(crate) difference: f32,
}

pub(crate) fn pictures(
    of: Option<&TextureDesc>,
    one: &[u8],
    other: &[u8],
) -> Result<Seen, RecorderError> {
    let format = of.map(TextureDesc::wgpu_format);
    let (one, other) = (values(format, one)?, values(format, other)?);
    if one.len() != other.len() || one.is_empty() {
        let sizes = format!("{} and {} values", one.len(), other.len());
        return Err(RecorderError::Format(sizes));
    }
    let all = || one.iter().chain(&other).copied();
    // A number that is none is no small difference.
    let apart = |(one, other): (&f32, &f32)| {
        let apart = (one - other).abs();
        if apart.is_nan() { f32::INFINITY } else { apart }
    };
    Ok(Seen {
        values: one.len(),
        range: [
            all().fold(f32::INFINITY, f32::min),
            all().fold(f32::NEG_INFINITY, f32::max),
        ],
        difference: one.iter().zip(&other).map(apart).fold(0.0, f32::max),
    })
}

fn values(format: Option<TextureFormat>, bytes: &[u8]) -> Result<Vec<f32>, RecorderError> {
    Ok(match format {
        Some(TextureFormat::R8Unorm | TextureFormat::Rgba8Unorm) => {
            bytes.iter().map(|&byte| f32::from(byte) / 255.0).collect()
        }
        Some(TextureFormat::R16Float | TextureFormat::Rgba16Float) => {
            let halves = bytes.chunks_exact(2);
            halves
                .map(|it| f16::from_le_bytes([it[0], it[1]]).to_f32())
                .collect()
        }
        other => return Err(RecorderError::Format(format!("{other:?}"))),
    })
}
