//! Maps and devices.

use moment_shadows::{MapEncoding, Profile, Storage, Technique};
use moment_shadows_graph::{Capabilities, TextureDesc};
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

pub(crate) fn gpu() -> Gpu {
    Gpu::open(Profile::Native).unwrap()
}

/// This device, as a graphics card and as a processor: both have the same formats, but other tiles.
pub(crate) fn both(gpu: &Gpu) -> [Capabilities; 2] {
    [false, true].map(|software_adapter| Capabilities {
        software_adapter,
        ..Capabilities::of_device(&gpu.adapter, &gpu.device)
    })
}

pub(crate) fn random(seed: u64) -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(seed)
}

pub(crate) fn encoding(technique: Technique, storage: Storage) -> MapEncoding {
    MapEncoding::new(technique, storage).unwrap()
}

pub(crate) fn map(encoding: &MapEncoding, size: [u32; 2], layers: u32) -> TextureDesc {
    TextureDesc {
        layers,
        ..TextureDesc::of_map(encoding.clone(), size)
    }
}

/// Bytes of a texture full of noise over the whole range of its channels.
pub(crate) fn noise(desc: &TextureDesc, seed: u64) -> Vec<u8> {
    let mut random = random(seed);
    let encoding = desc.encoding.as_ref().unwrap();
    let count =
        (desc.size[0] * desc.size[1] * desc.layers * encoding.technique().row().channels) as usize;
    match encoding.storage() {
        Storage::Float16 => (0..count)
            .flat_map(|_| half::f16::from_f32(random.random_range(-0.5..=0.5)).to_le_bytes())
            .collect(),
        Storage::Float32 => (0..count)
            .flat_map(|_| random.random_range(-1.1_f32..=1.1).to_le_bytes())
            .collect(),
        _ => (0..count)
            .flat_map(|_| random.random::<u16>().to_le_bytes())
            .collect(),
    }
}
