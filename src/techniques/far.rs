//! Texels of a map in which everything is at the far end: what casts no shadow. Zeros do.

use crate::Storage;

/// Channels in [0, 1], plane by plane, as a storage of them holds them: floats are centred.
pub(super) fn centred(planes: &[[f64; 4]], storage: Storage) -> Vec<[f64; 4]> {
    let middle = match storage {
        Storage::Float16 | Storage::Float32 => 0.5,
        Storage::Unorm8 | Storage::Unorm10 | Storage::Unorm16 | Storage::Fixed32 => 0.0,
        Storage::Packed64 | Storage::Packed32 => 0.0,
    };
    let planes = planes.iter();
    planes.map(|plane| plane.map(|it| it - middle)).collect()
}

/// The texels for each of the storages.
pub(super) fn of_each(
    storages: &[Storage],
    texels: impl Fn(Storage) -> Vec<[f64; 4]>,
) -> Vec<Vec<[f64; 4]>> {
    storages.iter().map(|&storage| texels(storage)).collect()
}
