//! Four moments of random patches as the storages hold them.

#[path = "../support/patches.rs"]
mod support;

use moment_shadows::Storage;
use support::Patch;

pub(crate) use support::{filtered as filtered_channels, patch};

/// Moments of a texel's channels in a storage, before the moment bias.
pub(crate) fn filtered(depths: &Patch, storage: Storage) -> [f64; 4] {
    decoded(
        support::filtered(depths, storage, |depth| encoded(depth, storage)),
        storage,
    )
}

fn encoded(depth: f64, storage: Storage) -> [f32; 4] {
    let root = 3.0_f64.sqrt();
    let [b1, b2, b3, b4] = [1, 2, 3, 4].map(|power| depth.powi(power));
    let channels = [
        1.5 * b1 - 2.0 * b3 + 0.5,
        4.0 * b2 - 4.0 * b4,
        root / 2.0 * b1 - 2.0 * root / 9.0 * b3 + 0.5,
        0.5 * b2 + 0.5 * b4,
    ];
    match storage {
        Storage::Unorm16 => channels.map(|channel| channel as f32),
        Storage::Float16 => channels.map(|channel| (channel - 0.5) as f32),
        _ => [b1, b2, b3, b4].map(|moment| moment as f32),
    }
}

fn decoded(channels: [f32; 4], storage: Storage) -> [f64; 4] {
    let channels = channels.map(f64::from);
    let [r, g, b, a] = match storage {
        Storage::Unorm16 => [
            channels[0] - 0.5,
            channels[1],
            channels[2] - 0.5,
            channels[3],
        ],
        Storage::Float16 => [
            channels[0],
            channels[1] + 0.5,
            channels[2],
            channels[3] + 0.5,
        ],
        _ => return channels,
    };
    let root = 3.0_f64.sqrt();
    [
        -r / 3.0 + root * b,
        0.125 * g + a,
        -0.75 * r + 0.75 * root * b,
        -0.125 * g + a,
    ]
}
