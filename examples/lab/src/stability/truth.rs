//! The truth in f64: the share of surfaces in front of the fragment, from the input alone.

use moment_shadows::{DepthConversion, Kernel};

use super::input::Input;

/// PCG hash of a place in a pattern, as the shader has it: integers are the same on both sides.
fn pattern(seed: u32, place: u32) -> u32 {
    let state = seed
        .wrapping_add(place.wrapping_mul(0x9e37_79b9))
        .wrapping_mul(747_796_405)
        .wrapping_add(2_891_336_453);
    let word = ((state >> ((state >> 28) + 4)) ^ state).wrapping_mul(277_803_737);
    (word >> 22) ^ word
}

/// The shares of the surfaces, summing to 1; none for texels that no surfaces made.
#[must_use]
pub fn shares(input: &Input, kernels: &[Kernel]) -> Option<[f64; 8]> {
    let mut shares = [0.0; 8];
    match input.kind {
        Input::MIXTURE => shares = input.weights.map(f64::from),
        Input::PATCH => {
            let weights = kernels.get(input.kernel as usize)?.weights();
            let mut rows = [0.0; 2];
            for (tap, &weight) in (0..).zip(weights) {
                let row = pattern(input.column, tap / input.column_run) & 1;
                rows[row as usize] += f64::from(weight);
            }
            let count = input.count;
            let next = f64::from(input.coverage) / 4.0;
            for (tap, &weight) in (0..).zip(weights) {
                for (seed, row) in input.rows.into_iter().zip(rows) {
                    let texel = pattern(seed, tap / input.row_run) % count;
                    let share = f64::from(weight) * row;
                    shares[texel as usize] += (1.0 - next) * share;
                    shares[((texel + 1) % count) as usize] += next * share;
                }
            }
        }
        _ => return None,
    }
    // The weights are normalised but for one rounding, of which the truth is to know nothing.
    let sum: f64 = shares.iter().sum();
    Some(shares.map(|share| share / sum))
}

/// Moment depth of a stored depth by the definition of `DepthConversion`; NaN counts as the far end.
fn converted(stored: f32, conversion: &DepthConversion) -> f64 {
    if stored.is_nan() {
        return 1.0;
    }
    let [scale, offset] = [conversion.scale, conversion.offset].map(f64::from);
    let d = f64::from(stored.clamp(f32::MIN, f32::MAX))
        .mul_add(scale, offset)
        .clamp(0.0, 1.0);
    let between = |ends: [f32; 2]| (1.0 - d) * f64::from(ends[0]) + d * f64::from(ends[1]);
    let divisor = between(conversion.denominator).max(1e-30);
    (between(conversion.numerator) / divisor).clamp(-1.0, 1.0)
}

fn moment_depth(depth: f32, input: &Input) -> f64 {
    if input.converted == 1 {
        converted(depth, &input.conversion)
    } else {
        // The far end lies behind all that is beyond it.
        f64::from(depth).clamp(-1.0, 1.0)
    }
}

/// The share of surfaces strictly in front of the fragment; `None` where texel or fragment do not result from surfaces.
#[must_use]
pub fn truth(input: &Input, kernels: &[Kernel]) -> Option<f64> {
    if !input.fragment_depth.is_finite() {
        return None;
    }
    let fragment = moment_depth(input.fragment_depth, input);
    let in_front = shares(input, kernels)?
        .into_iter()
        .zip(input.depths)
        .filter(|&(_, depth)| moment_depth(depth, input) < fragment)
        .map(|(share, _)| share)
        .sum::<f64>();
    Some(in_front.min(1.0))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use super::super::kernels::kernels;
    use super::*;

    #[test]
    fn the_truth_counts_what_is_strictly_in_front() {
        let mut input = Input {
            depths: [-0.5, 0.0, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0],
            weights: [0.25, 0.25, 0.5, 0.0, 0.0, 0.0, 0.0, 0.0],
            ..Input::default()
        };
        for (fragment, expected) in [(-0.5, 0.0), (0.0, 0.25), (0.1, 0.5), (2.0, 1.0)] {
            input.fragment_depth = fragment;
            assert_eq!(truth(&input, &[]), Some(expected));
        }
        input.fragment_depth = f32::NAN;
        assert_eq!(truth(&input, &[]), None);
    }

    #[test]
    fn all_weights_of_a_patch_are_shares() {
        let kernels = kernels().unwrap();
        let input = Input {
            kind: Input::PATCH,
            count: 3,
            kernel: 15,
            coverage: 1,
            rows: [1, 2],
            column: 3,
            row_run: 7,
            column_run: 5,
            ..Input::default()
        };
        let shares = shares(&input, &kernels).unwrap();
        assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        assert!(shares[..3].iter().all(|&share| share > 0.0) && shares[3..] == [0.0; 5]);
    }

    #[test]
    fn nearer_stored_depths_are_in_front_under_every_convention() {
        let reversed = Input {
            depths: [0.75; 8],
            weights: [0.125; 8],
            fragment_depth: 0.25,
            converted: 1,
            conversion: DepthConversion::orthographic().reversed(),
            ..Input::default()
        };
        assert_eq!(truth(&reversed, &[]), Some(1.0));
        let forward = Input {
            conversion: DepthConversion::orthographic(),
            ..reversed
        };
        assert_eq!(truth(&forward, &[]), Some(0.0));
    }
}
