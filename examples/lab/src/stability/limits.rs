//! How far above the truth the shadow intensity of each technique may be in each storage.

use moment_shadows::{EsmFiltering, MapEncoding, Storage, Technique};

/// Half a unit in the last place of float32 below 1.
const HALF_ULP: f64 = 1.0 / (1 << 24) as f64;

/// A resolve and both passes of a blur round.
const STAGES: f64 = 3.0;

/// Half a step of a storage for channels of at most 1; for float16 of at most 1/2, around which its techniques centre them.
fn half_step(storage: Storage) -> f64 {
    match storage {
        Storage::Unorm8 => 0.5 / 255.0,
        Storage::Unorm16 => 0.5 / 65535.0,
        Storage::Float16 => 1.0 / f64::from(1 << 13),
        _ => 0.5 * HALF_ULP,
    }
}

/// The excess over the truth that is documented for a pair. More is a fault.
#[must_use]
pub fn largest_excess(encoding: &MapEncoding) -> f64 {
    let storage = encoding.storage();
    match encoding.technique() {
        _ => 0.0 * STAGES * half_step(storage),
    }
}
