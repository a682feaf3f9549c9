//! Views of lights that follow from a camera, a light and a filter: cascades, spots, faces, and their places in a map.
#![allow(
    clippy::unwrap_used,
    clippy::expect_used,
    clippy::panic,
    reason = "a test that fails says where"
)]

mod atlas;
mod camera;
mod cascades;
mod point_light;
mod refused;
mod spot;

use glam::{DMat4, DVec2, DVec3, DVec4};
use moment_shadows::{CascadeSplits, Cascades, LightView, Tile};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

/// Numbers of a test.
pub(crate) fn random() -> ChaCha8Rng {
    ChaCha8Rng::seed_from_u64(7)
}

pub(crate) fn direction(random: &mut ChaCha8Rng) -> DVec3 {
    loop {
        let vector = DVec3::from([0; 3].map(|_| random.random_range(-1.0..1.0)));
        if (0.1..1.0).contains(&vector.length()) {
            return vector.normalize();
        }
    }
}

/// Where a view's map has a place of the scene, in texels of its region, and its stored depth; nothing behind the light.
pub(crate) fn place(view: &LightView, point: DVec3) -> Option<(DVec2, f64)> {
    let clip = DMat4::from_cols_array_2d(&view.clip_from_world) * point.extend(1.0);
    let extent = DVec2::from(view.region.extent.map(f64::from));
    let uv = DVec2::new(0.5 + 0.5 * clip.x / clip.w, 0.5 - 0.5 * clip.y / clip.w);
    (clip.w > 0.0).then(|| (uv * extent, clip.z / clip.w))
}

/// How many texels a place lies within the region, less its guard band; negative outside.
pub(crate) fn within(view: &LightView, texel: DVec2) -> f64 {
    let extent = DVec2::from(view.region.extent.map(f64::from));
    texel.min(extent - texel).min_element() - f64::from(view.guard)
}

pub(crate) const TILE: Tile = Tile {
    texels: 512,
    filter_radius: 4.0,
};

pub(crate) fn cascades() -> Cascades {
    Cascades {
        direction: [0.3, -1.0, 0.4],
        splits: CascadeSplits::Blend {
            count: 4,
            logarithmic: 0.7,
        },
        near: 0.1,
        far: 200.0,
        overlap: 0.1,
        blend: 0.0,
        casters: None,
        pancaking: true,
        reversed: false,
        tile: TILE,
    }
}

/// A matrix by rows.
pub(crate) fn rows(rows: [DVec4; 4]) -> DMat4 {
    DMat4::from_cols(rows[0], rows[1], rows[2], rows[3]).transpose()
}
