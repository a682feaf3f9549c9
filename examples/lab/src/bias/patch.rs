//! Random patches of a light's depth map, of all kinds that bring moments to the boundary of the possible.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

/// Texels per side: the kernel's.
pub(super) const SIDE: usize = 9;

/// Moment depths, row by row, in [-1, 1].
pub(super) type Patch = [f32; SIDE * SIDE];

/// One patch.
pub(super) fn patch(random: &mut ChaCha8Rng) -> Patch {
    let depth = |random: &mut ChaCha8Rng| -> f64 {
        // A share of surfaces is clamped to an end of the range.
        match random.random_range(0..8) {
            0 => -1.0,
            1 => 1.0,
            _ => random.random_range(-1.0..=1.0),
        }
    };
    let small = |random: &mut ChaCha8Rng, exponents: core::ops::Range<f64>| {
        10.0_f64.powf(random.random_range(exponents))
    };
    let (kind, count) = (random.random_range(0..8), random.random_range(1..=6));
    match kind {
        // Several surfaces with straight edges.
        0 | 1 => {
            let depths: Vec<f64> = (0..count).map(|_| depth(random)).collect();
            let which = regions(random, count);
            core::array::from_fn(|texel| depths[which[texel]] as f32)
        }
        // Several surfaces, texel by texel.
        2 => {
            let depths: Vec<f64> = (0..count).map(|_| depth(random)).collect();
            core::array::from_fn(|_| depths[random.random_range(0..count)] as f32)
        }
        // Layers that almost coincide.
        3 => {
            let (base, gap) = (depth(random), small(random, -7.0..-1.0));
            let which = regions(random, count.max(2));
            core::array::from_fn(|texel| clamped(base + gap * which[texel] as f64))
        }
        // One slope, or two.
        4 | 5 => {
            let mut planes = Vec::new();
            for _ in 0..2 {
                let gradient = small(random, -6.2..-0.7);
                let angle = random.random_range(0.0..core::f64::consts::TAU);
                planes.push((
                    depth(random),
                    gradient * angle.cos(),
                    gradient * angle.sin(),
                ));
            }
            let which = if kind == 4 {
                [0; SIDE * SIDE]
            } else {
                regions(random, 2)
            };
            core::array::from_fn(|texel| {
                let (base, along_x, along_y) = planes[which[texel]];
                let [x, y] = centred(texel);
                clamped(base + along_x * x + along_y * y)
            })
        }
        // Noise around a surface, or everywhere.
        6 => {
            let (base, width) = (depth(random), small(random, -6.0..0.3));
            core::array::from_fn(|_| clamped(base + width * random.random_range(-1.0..=1.0)))
        }
        // One depth, often a special one.
        _ => {
            let special = [-1.0, 0.0, 1.0, depth(random), depth(random), depth(random)];
            [special[random.random_range(0..special.len())] as f32; SIDE * SIDE]
        }
    }
}

fn clamped(depth: f64) -> f32 {
    depth.clamp(-1.0, 1.0) as f32
}

/// A texel's place relative to the centre.
fn centred(texel: usize) -> [f64; 2] {
    let middle = (SIDE / 2) as f64;
    [
        (texel % SIDE) as f64 - middle,
        (texel / SIDE) as f64 - middle,
    ]
}

/// Which of `count` surfaces each texel shows: each lies in front of the previous ones on one side of a random line.
fn regions(random: &mut ChaCha8Rng, count: usize) -> [usize; SIDE * SIDE] {
    let mut which = [0; SIDE * SIDE];
    for surface in 1..count {
        let angle = random.random_range(0.0..core::f64::consts::TAU);
        let offset = random.random_range(-5.0..5.0);
        for (texel, which) in which.iter_mut().enumerate() {
            let [x, y] = centred(texel);
            if x * angle.cos() + y * angle.sin() > offset {
                *which = surface;
            }
        }
    }
    which
}
