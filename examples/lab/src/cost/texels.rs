//! Texels of maps of moments: as bytes of a texture, and as numbers.

use half::f16;
use moment_shadows::Storage;

/// Channel values as a shader sees them, four per texel, row by row.
pub type Channels = Vec<[f64; 4]>;

/// The bytes of a texture with these channel values, rounded to nearest.
#[must_use]
pub fn encode(storage: Storage, channels: &[[f64; 4]]) -> Vec<u8> {
    let flat = channels.iter().flatten();
    match storage {
        Storage::Float16 => flat
            .flat_map(|&value| f16::from_f64(value).to_le_bytes())
            .collect(),
        Storage::Float32 => flat
            .flat_map(|&value| (value as f32).to_le_bytes())
            .collect(),
        // Unorm16, and whatever 16-bit normalised storage is added to it.
        _ => flat
            .flat_map(|&value| ((value.clamp(0.0, 1.0) * 65535.0).round() as u16).to_le_bytes())
            .collect(),
    }
}

/// The channel values of a texture's bytes.
#[must_use]
pub fn decode(storage: Storage, bytes: &[u8]) -> Channels {
    let flat: Vec<f64> = match storage {
        Storage::Float16 => bytes
            .chunks_exact(2)
            .map(|pair| f16::from_le_bytes([pair[0], pair[1]]).to_f64())
            .collect(),
        Storage::Float32 => bytes
            .chunks_exact(4)
            .map(|four| f64::from(f32::from_le_bytes([four[0], four[1], four[2], four[3]])))
            .collect(),
        _ => bytes
            .chunks_exact(2)
            .map(|pair| f64::from(u16::from_le_bytes([pair[0], pair[1]])) / 65535.0)
            .collect(),
    };
    flat.chunks_exact(4)
        .map(|four| [four[0], four[1], four[2], four[3]])
        .collect()
}

/// The largest value of a channel's range, and the step between values next to it: what one rounding is half of.
#[must_use]
pub fn step(storage: Storage) -> f64 {
    match storage {
        // Channels are centred: values below 1/2 with 11 significant bits.
        Storage::Float16 => 2.0_f64.powi(-12),
        Storage::Float32 => 2.0_f64.powi(-24),
        _ => 1.0 / 65535.0,
    }
}

/// Reproducible noise over a storage's whole range of channels: the worst that rounding can meet.
#[must_use]
pub fn noise(storage: Storage, texels: usize) -> Channels {
    use rand::{RngExt, SeedableRng};
    let mut random = rand_chacha::ChaCha8Rng::seed_from_u64(1);
    let centre = if storage == Storage::Float16 {
        0.5
    } else {
        0.0
    };
    (0..texels)
        .map(|_| [0; 4].map(|_| random.random::<f64>() - centre))
        .collect()
}
