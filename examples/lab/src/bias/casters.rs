//! Random translucent casters over a patch, as a host blends them into a map.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::patch::{Patch, SIDE};

/// A translucent caster: how much it covers of every texel, and where it lies there.
pub(super) struct Caster {
    pub(super) depths: Patch,
    pub(super) alphas: [f32; SIDE * SIDE],
}

/// So many casters, close to each other in most patches: many surfaces that lie apart bring moments inside of the possible, where rounding
/// does no harm. Half of all patches have casters of one depth and one opacity all over, whose errors no filter averages away: panes of
/// glass. The opacities of a patch have one order of magnitude, since errors add up where each caster covers little.
pub(super) fn casters(random: &mut ChaCha8Rng, count: usize) -> Vec<Caster> {
    if count == 0 {
        return Vec::new();
    }
    let panes = random.random_bool(0.5);
    let largest = 10.0_f32.powf(random.random_range(-2.0..=0.0));
    let ends = [-1.0, 1.0, random.random_range(-1.0..=1.0)];
    let base: f32 = ends[random.random_range(0..ends.len())];
    let gap = 10.0_f32.powf(random.random_range(-6.0..0.3));
    let casters = (0..count).map(|_| {
        let depth = |random: &mut ChaCha8Rng| {
            (base + gap * random.random_range(-1.0..=1.0)).clamp(-1.0, 1.0)
        };
        let alpha = |random: &mut ChaCha8Rng| largest * random.random_range(0.2..=1.0);
        if panes {
            Caster {
                depths: [depth(random); SIDE * SIDE],
                alphas: [alpha(random); SIDE * SIDE],
            }
        } else {
            Caster {
                depths: core::array::from_fn(|_| depth(random)),
                alphas: core::array::from_fn(|_| alpha(random)),
            }
        }
    });
    casters.collect()
}
