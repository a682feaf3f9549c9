//! Inputs that no map should hold, and some do.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::input::Input;
use super::strata::{diracs, signed_magnitude};

/// Any bits of a float: not finite, subnormal, huge, or in the range of channels.
fn bits(random: &mut ChaCha8Rng) -> f32 {
    let plain: u32 = random.random();
    let bits = match random.random_range(0..5) {
        0 => plain,
        1 => (plain & 0x807f_ffff) | [0, 0x7f80_0000][random.random_range(0..2)],
        2 => return special(random),
        3 => return random.random_range(-1.0..=1.0),
        _ => return signed_magnitude(random, -45.0, 38.0) as f32,
    };
    f32::from_bits(bits)
}

/// A float at the edge of some range.
fn special(random: &mut ChaCha8Rng) -> f32 {
    const SPECIAL: [f32; 14] = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        -0.5,
        f32::MAX,
        f32::MIN,
        f32::MIN_POSITIVE,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
        65504.0,
        1e19,
    ];
    SPECIAL[random.random_range(0..SPECIAL.len())]
}

/// A texel of random bits, of moments that rounding made impossible, or of negative variance.
pub(super) fn texel(random: &mut ChaCha8Rng) -> Input {
    let mut input = Input {
        kind: Input::TEXEL,
        ..Input::default()
    };
    let surface: f32 = random.random_range(-1.0..=1.0);
    let kind = random.random_range(0..4);
    for channel in 0..4 {
        let power = surface.powi(channel + 1);
        input.weights[channel as usize] = match kind {
            0 => bits(random),
            1 => random.random_range(-1.0..=1.0),
            // One surface and a few roundings, to impossible moments from both sides.
            2 => f32::from_bits(
                power
                    .to_bits()
                    .wrapping_add(random.random_range(0..9))
                    .wrapping_sub(4),
            ),
            // Even moments that are too small: a negative variance.
            _ => power * [1.0, random.random_range(0.0..1.0)][(channel % 2) as usize],
        };
    }
    input.fragment_depth = match random.random_range(0..4) {
        0 => surface,
        1 => bits(random),
        _ => random.random_range(-1.0..=1.0),
    };
    input
}

/// Depths and fragments that are subnormal, infinite or not numbers.
pub(super) fn not_finite(random: &mut ChaCha8Rng) -> Input {
    let mut input = diracs(random);
    input.converted = 1;
    for index in 0..input.count as usize {
        input.depths[index] = match random.random_range(0..3) {
            0 => random.random_range(0.0..=1.0),
            _ => bits(random),
        };
    }
    input.fragment_depth = match random.random_range(0..4) {
        0 => bits(random),
        1 => input.depths[0],
        _ => random.random_range(0.0..=1.0),
    };
    // As a moment depth that nothing has clamped.
    if random.random_range(0..4) == 0 {
        input.converted = 0;
        input.depths = input.depths.map(|depth| {
            if (-1.0..=1.0).contains(&depth) {
                depth
            } else {
                f32::MIN_POSITIVE / 4.0
            }
        });
    }
    input
}
