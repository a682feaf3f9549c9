//! What is allowed to packed texels, which hold surfaces instead of moments: their depths and weights are rounded.

use moment_shadows::Storage;

use super::limits::STAGES;

/// A step of the depths of a texel of 64 bits, and one of its weights.
const STEPS: [f64; 2] = [1.0 / 32767.0, 1.0 / 65535.0];

/// By how much the fragment is moved towards the light: each stage rounds the depths of surfaces outwards by up to a step. A surface
/// would lie that far in front of itself, as in every depth map of that resolution, so that a receiver bias is needed.
#[must_use]
pub fn receiver_bias(storage: Storage) -> f64 {
    match storage.is_packed() {
        true => STAGES * STEPS[0],
        false => 0.0,
    }
}

/// What is above the truth besides the moment bias.
pub(super) fn rounding(storage: Storage) -> f64 {
    match storage {
        Storage::Packed64 => STAGES * STEPS[1] + WIDENED * STAGES * STEPS[0],
        Storage::Packed32 => 1.5 / 256.0 + shortened(storage),
        _ => 0.0,
    }
}

/// Surfaces that move outwards keep their mean, and so the nearer one gains weight that is not there: a step over the distance between
/// both. Of two close surfaces the moment bias hides that; the test finds how much is left, in steps.
const WIDENED: f64 = 2.3;

/// The same of a texel of 32 bits, once its weight is rounded to half of 128 steps that are 3 / 2 times as wide in the middle. Its distance,
/// n^2 / 255^2 of the range, is rounded down by up to one in n: by 2 / n of itself. The bound of a fragment behind both surfaces is
/// 1 - 1 / (1 + x^2 / variance), and changes by half of the relative error of the distance at most. For small n the variance that the
/// moment bias adds to that of two surfaces of equal weight says how much of it there is to see.
fn shortened(storage: Storage) -> f64 {
    let bias = storage.moment_bias();
    let added = f64::from(bias.alpha) * f64::from(bias.second);
    let at = |n: u32| {
        let distance = 2.0 * (f64::from(n) / 255.0).powi(2);
        let variance = 0.25 * distance * distance;
        variance / (variance + added) / f64::from(n)
    };
    (1..=255).map(at).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::*;
    use crate::oracle::{Mixture, hamburger, rational};

    /// The exact bound of a fragment at `upper`, less the receiver bias, once the surfaces there and at `lower`, which has no weight, moved
    /// outwards by a step per stage: all of it is excess.
    fn widened(lower: f64, upper: f64) -> f64 {
        let moved = STAGES * STEPS[0];
        let ends = [(lower - moved).max(-1.0), (upper + moved).min(1.0)];
        let weight = (ends[1] - upper) / (ends[1] - ends[0]);
        let atoms = [(ends[0], weight), (ends[1], 1.0 - weight)];
        let bias = Storage::Packed64.moment_bias();
        let [alpha, beta] = [bias.alpha, bias.second].map(f64::from);
        let mixture = Mixture::new(&atoms).unwrap().biased(alpha, beta).unwrap();
        let depth = rational(upper - receiver_bias(Storage::Packed64)).unwrap();
        hamburger(&mixture.moments(4), &depth).unwrap().lower
    }

    #[test]
    fn surfaces_that_move_outwards_gain_no_more_than_is_allowed() {
        let mut largest = (0.0, 0.0, 0.0);
        for place in 0..25 {
            let lower = -1.0 + 0.06 * f64::from(place);
            for distance in 1..30 {
                let upper = lower + 1.6 * 0.8_f64.powi(distance);
                if upper <= 1.0 {
                    let excess = widened(lower, upper);
                    if excess > largest.0 {
                        largest = (excess, lower, upper);
                    }
                }
            }
        }
        println!("{largest:?}");
        let allowed = WIDENED * STAGES * STEPS[0];
        assert!(
            (0.95 * allowed..=allowed).contains(&largest.0),
            "{largest:?}"
        );
    }
}
