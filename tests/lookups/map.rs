//! A map whose mip levels are unrelated to each other, so that what a lookup reads shows, and lookups in f64.

use moment_shadows::MapRegion;
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

/// What texels outside of the region hold; those inside are below 1.
pub(crate) const OUTSIDE: f64 = 64.0;

pub(crate) struct Map {
    pub(crate) size: [u32; 2],
    pub(crate) region: MapRegion,
    /// The texels of each level, row by row.
    pub(crate) levels: Vec<Vec<[f64; 4]>>,
}

/// A region's first texel and its extent on a mip level, by the rule of halves that are rounded down.
pub(crate) fn on_level(region: MapRegion, level: u32) -> ([u32; 2], [u32; 2]) {
    let first = region.origin.map(|at| at / 2u32.pow(level));
    let end = [0, 1].map(|axis| (region.origin[axis] + region.extent[axis]) / 2u32.pow(level));
    (first, [end[0] - first[0], end[1] - first[1]])
}

impl Map {
    /// Multiples of 1/1024, which half precision holds.
    pub(crate) fn new(size: [u32; 2], region: MapRegion, levels: u32, seed: u64) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let levels = (0..levels).map(|level| {
            let ([x0, y0], [width, height]) = on_level(region, level);
            let [columns, rows] = size.map(|side| (side >> level).max(1));
            let texel = |index: u32| {
                let (x, y) = (index % columns, index / columns);
                let inside = x >= x0 && x - x0 < width && y >= y0 && y - y0 < height;
                [(); 4].map(|()| match inside {
                    true => f64::from(random.random_range(0..1024_u32)) / 1024.0,
                    false => OUTSIDE,
                })
            };
            (0..columns * rows).map(texel).collect()
        });
        let levels = levels.collect();
        Self {
            size,
            region,
            levels,
        }
    }

    /// The coarsest level on which the region has texels.
    pub(crate) fn last_level(&self) -> u32 {
        let has_texels = |level: &u32| on_level(self.region, *level).1.iter().all(|&side| side > 0);
        (0..self.levels.len() as u32).rfind(has_texels).unwrap()
    }

    /// A bilinear lookup on a level of an image of the region alone, whose last texels repeat for ever.
    pub(crate) fn bilinear(&self, uv: [f64; 2], level: u32) -> [f64; 4] {
        let (first, extent) = on_level(self.region, level);
        let columns = (self.size[0] >> level).max(1);
        let place = [0, 1].map(|axis| uv[axis] * f64::from(extent[axis]) - 0.5);
        let base = place.map(f64::floor);
        let mut sum = [0.0; 4];
        for [x, y] in [[0, 0], [1, 0], [0, 1], [1, 1]] {
            let [(column, share_x), (row, share_y)] = [(0, x), (1, y)].map(|(axis, step)| {
                let at = base[axis] + f64::from(step);
                let clamped = at.clamp(0.0, f64::from(extent[axis]) - 1.0) as u32;
                (first[axis] + clamped, 1.0 - (place[axis] - at).abs())
            });
            let texel = self.levels[level as usize][(row * columns + column) as usize];
            for (sum, channel) in sum.iter_mut().zip(texel) {
                *sum += share_x * share_y * channel;
            }
        }
        sum
    }

    /// Two levels, each with the share that it is near.
    pub(crate) fn trilinear(&self, uv: [f64; 2], level: f64) -> [f64; 4] {
        let level = level.clamp(0.0, f64::from(self.last_level()));
        let mut sum = [0.0; 4];
        for candidate in 0..=self.last_level() {
            let share = 1.0 - (level - f64::from(candidate)).abs();
            if share > 0.0 {
                let texel = self.bilinear(uv, candidate);
                for (sum, channel) in sum.iter_mut().zip(texel) {
                    *sum += share * channel;
                }
            }
        }
        sum
    }
}
