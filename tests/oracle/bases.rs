//! The published bases.

use moment_shadows_lab::basis::{
    Quantisation, four_moments, four_moments_of_unit_depth, powers, six_moments,
};

const SIGNED: [f64; 2] = [-1.0, 1.0];

/// `overshoot`: by how much channels may leave [0, 1] for depths in the interval, given the published digits.
fn channels_fill_their_range<const M: usize>(
    basis: &Quantisation<M>,
    [low, high]: [f64; 2],
    overshoot: f64,
) {
    let mut image = [[f64::INFINITY, f64::NEG_INFINITY]; M];
    for step in 0..=100_000 {
        let depth = low + (high - low) * f64::from(step) / 100_000.0;
        for (range, value) in image.iter_mut().zip(basis.encode(&powers(depth))) {
            *range = [range[0].min(value), range[1].max(value)];
        }
    }
    for (channel, [least, greatest]) in image.into_iter().enumerate() {
        assert!(least >= -overshoot, "channel {channel}: {least:e}");
        assert!(greatest <= 1.0 + overshoot, "channel {channel}: {greatest}");
        assert!(
            greatest - least > 0.9,
            "channel {channel}: {least}..{greatest}"
        );
    }
}

#[test]
fn channels_stay_in_their_range() {
    channels_fill_their_range(&four_moments(), SIGNED, 1e-15);
    channels_fill_their_range(&four_moments_of_unit_depth(), [0.0, 1.0], 6.6e-8);
    channels_fill_their_range(&six_moments(), SIGNED, 5e-12);
}

/// Rows of the inverse, as given by others with up to 17 digits (of the 17 an f64 keeps).
fn inverse_is_the_known_one<const M: usize>(basis: &Quantisation<M>, known: &[(usize, [f64; M])]) {
    for (row, digits) in known {
        for (entry, digit) in basis.inverse[*row].iter().zip(digits) {
            // Condition numbers reach 1e4, and the matrices have 9 to 12 digits.
            assert!(
                (entry - digit).abs() < 1e-11,
                "row {row}: {entry}, not {digit}"
            );
        }
    }
    for depth in [-0.7, 0.0, 0.3, 1.0] {
        let given = powers(depth);
        for (one, other) in basis.decode(&basis.encode(&given)).iter().zip(&given) {
            assert!((one - other).abs() < 1e-11, "{M} moments at {depth}");
        }
    }
}

#[test]
fn inverses_are_the_known_ones() {
    let root = 3.0_f64.sqrt();
    inverse_is_the_known_one(
        &four_moments(),
        &[
            (0, [-1.0 / 3.0, 0.0, root, 0.0]),
            (3, [0.0, -0.125, 0.0, 1.0]),
        ],
    );
    inverse_is_the_known_one(
        &four_moments_of_unit_depth(),
        &[
            (
                0,
                [
                    0.22277441458975106,
                    0.07719728607812729,
                    0.7926986636560285,
                    0.031941755461409704,
                ],
            ),
            (
                3,
                [
                    0.163127442991378,
                    0.25914322664410966,
                    0.6539092496736952,
                    -0.3376131734058174,
                ],
            ),
        ],
    );
    inverse_is_the_known_one(
        &six_moments(),
        &[
            (
                0,
                [
                    -0.02877789191977914,
                    0.4763555042123262,
                    1.5524280897137293,
                    0.0,
                    0.0,
                    0.0,
                ],
            ),
            (
                2,
                [
                    0.09995235706024454,
                    0.8453258093069344,
                    1.0547257075981562,
                    0.0,
                    0.0,
                    0.0,
                ],
            ),
            (
                5,
                [
                    0.0,
                    0.0,
                    0.0,
                    -0.37498825271617836,
                    0.21876713299424835,
                    0.8118988179321994,
                ],
            ),
        ],
    );
}
