//! The published bases.

use moment_shadows_lab::basis::{Quantisation, published_quantisations};

fn of(count: usize, interval: [f64; 2]) -> Quantisation {
    let mut all = published_quantisations().into_iter();
    all.find(|basis| basis.count() == count && basis.interval == interval)
        .unwrap()
}

#[test]
fn channels_stay_in_their_range() {
    for basis in published_quantisations() {
        for (channel, [least, greatest]) in basis.image(100_000).into_iter().enumerate() {
            let name = basis.name;
            assert!(
                least >= -basis.overshoot,
                "{name}, channel {channel}: {least:e}"
            );
            assert!(
                greatest <= 1.0 + basis.overshoot,
                "{name}, channel {channel}: {greatest}"
            );
            // And fill it, as they should.
            assert!(
                greatest - least > 0.9,
                "{name}, channel {channel}: {least}..{greatest}"
            );
        }
    }
}

/// Rows of the inverses, as given by others with up to 17 digits (of the 17 an f64 keeps).
#[test]
fn inverses_are_the_known_ones() {
    let root = 3.0_f64.sqrt();
    let [unit, signed] = [[0.0, 1.0], [-1.0, 1.0]];
    let known: [(usize, [f64; 2], usize, Vec<f64>); 10] = [
        (4, signed, 0, vec![-1.0 / 3.0, 0.0, root, 0.0]),
        (4, signed, 3, vec![0.0, -0.125, 0.0, 1.0]),
        (
            4,
            unit,
            0,
            vec![
                0.22277441458975106,
                0.07719728607812729,
                0.7926986636560285,
                0.031941755461409704,
            ],
        ),
        (
            4,
            unit,
            3,
            vec![
                0.163127442991378,
                0.25914322664410966,
                0.6539092496736952,
                -0.3376131734058174,
            ],
        ),
        (
            6,
            signed,
            0,
            vec![
                -0.02877789191977914,
                0.4763555042123262,
                1.5524280897137293,
                0.0,
                0.0,
                0.0,
            ],
        ),
        (
            6,
            signed,
            2,
            vec![
                0.09995235706024454,
                0.8453258093069344,
                1.0547257075981562,
                0.0,
                0.0,
                0.0,
            ],
        ),
        (
            6,
            signed,
            5,
            vec![
                0.0,
                0.0,
                0.0,
                -0.37498825271617836,
                0.21876713299424835,
                0.8118988179321994,
            ],
        ),
        (
            6,
            unit,
            0,
            vec![
                -0.7923732596684603,
                0.2341398573333484,
                0.03642022923518546,
                -0.026311192653028,
                0.0051060590045215815,
                -0.006452769231234413,
            ],
        ),
        (
            6,
            unit,
            2,
            vec![
                -0.733942572105381,
                0.27997206660120066,
                -0.02321801428292656,
                -0.014368192159273879,
                0.00857563622937179,
                0.32315166678414164,
            ],
        ),
        (
            6,
            unit,
            5,
            vec![
                -0.5804097373083305,
                0.3940151285624577,
                -0.0336729124382498,
                0.024972808928384004,
                -0.043690863815864525,
                0.4285574003332607,
            ],
        ),
    ];
    for (count, interval, row, digits) in known {
        let basis = of(count, interval);
        for (entry, digit) in basis.inverse[row].iter().zip(&digits) {
            // Condition numbers reach 1e4, and the matrices have 9 to 12 digits.
            assert!(
                (entry - digit).abs() < 1e-11,
                "{}, row {row}: {entry}, not {digit}",
                basis.name
            );
        }
    }
    for basis in published_quantisations() {
        for depth in [-0.7, 0.0, 0.3, 1.0] {
            let powers = basis.powers(depth);
            let decoded = basis.decode(&basis.encode(&powers));
            for (one, other) in decoded.iter().zip(&powers) {
                assert!((one - other).abs() < 1e-11, "{} at {depth}", basis.name);
            }
        }
    }
}

#[test]
fn determinants_are_as_published() {
    let unit = [0.0, 1.0];
    let signed = [-1.0, 1.0];
    for (count, interval, bits, digits) in [
        // 12.3 in the paper.
        (4, unit, 12.278, 5e-4),
        // 10 bits by signed depth, and det = 8 / sqrt(3).
        (4, signed, 10.0 + (8.0 / 3.0_f64.sqrt()).log2(), 1e-12),
        (2, unit, 2.0, 1e-12),
        // 30.5 in the paper.
        (6, unit, 30.511, 5e-4),
        (6, signed, 21.0 + 729.990_f64.log2(), 1e-5),
    ] {
        let gained = of(count, interval).bits_gained();
        assert!(
            (gained - bits).abs() < digits,
            "{count} moments on {interval:?}: {gained}"
        );
    }
}
