//! Where alpha-masked materials have holes, in f64: what the host's fragment shader discards.

use glam::DVec2;
use wgpu::AddressMode;

use crate::scene::{Image, Material, Mip, mips};

/// The holes of a masked material.
pub(super) struct Opacity {
    /// Multiplied with the texture's alpha.
    alpha: f64,
    /// Alpha below this is a hole.
    mask: f64,
    /// Empty for a material without a texture.
    mips: Vec<Mip>,
    /// How it goes on beyond its edges.
    wrap: [AddressMode; 2],
}

impl Opacity {
    /// The opacity of a material; `None` if it has no holes.
    pub(super) fn of(material: &Material, images: &[Image]) -> Option<Self> {
        let image = material.texture.and_then(|texture| images.get(texture));
        Some(Self {
            alpha: f64::from(material.base_colour[3]),
            mask: f64::from(material.mask?),
            mips: image.map_or_else(Vec::new, mips),
            wrap: material.wrap,
        })
    }

    /// Whether there is a hole at `uv`, which changes by `across` from a pixel to the next one in its row and by `down`
    /// to that in the next row. Sampled as the host does: trilinearly, with the mip that the longer of the two
    /// asks for.
    pub(super) fn is_hole(&self, uv: DVec2, across: DVec2, down: DVec2) -> bool {
        let Some(finest) = self.mips.first() else {
            return self.alpha < self.mask;
        };
        let size = DVec2::from_array(finest.size.map(f64::from));
        let footprint = (across * size).length().max((down * size).length());
        let last = self.mips.len() - 1;
        // Beyond all numbers where the surface is edge-on: the coarsest mip.
        let lod = if footprint.is_finite() {
            footprint.log2().clamp(0.0, last as f64)
        } else {
            last as f64
        };
        let fine = (lod as usize).min(last);
        let coarse = (fine + 1).min(last);
        let [near, far] = [fine, coarse].map(|mip| bilinear_alpha(&self.mips[mip], uv, self.wrap));
        self.alpha * (near + (lod - fine as f64) * (far - near)) < self.mask
    }
}

/// Alpha from 0 to 1 at `uv`, filtered linearly.
fn bilinear_alpha(mip: &Mip, uv: DVec2, wrap: [AddressMode; 2]) -> f64 {
    let [width, height] = mip.size.map(i64::from);
    let place = uv * DVec2::new(width as f64, height as f64) - 0.5;
    let base = place.floor();
    let weight = place - base;
    let texel = |dx: i64, dy: i64| {
        let x = wrapped((base.x as i64).saturating_add(dx), width, wrap[0]);
        let y = wrapped((base.y as i64).saturating_add(dy), height, wrap[1]);
        let index = ((y * width + x) * 4 + 3) as usize;
        f64::from(mip.rgba.get(index).copied().unwrap_or(255)) / 255.0
    };
    let row = |dy: i64| texel(0, dy) + weight.x * (texel(1, dy) - texel(0, dy));
    row(0) + weight.y * (row(1) - row(0))
}

/// The texel of `size` ones in a row that stands for texel `at` beyond its ends.
fn wrapped(at: i64, size: i64, wrap: AddressMode) -> i64 {
    match wrap {
        AddressMode::Repeat => at.rem_euclid(size),
        AddressMode::MirrorRepeat => {
            let at = at.rem_euclid(2 * size);
            at.min(2 * size - 1 - at)
        }
        AddressMode::ClampToEdge | AddressMode::ClampToBorder => at.clamp(0, size - 1),
    }
}
