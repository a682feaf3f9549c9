//! The published bases and biases, and the comparison of bases.

use moment_shadows_lab::basis::{
    Quantisation, SubsetError, Subsets, published_biases, published_quantisations,
};
use moment_shadows_lab::command::bases::{self, BasesError};
use moment_shadows_lab::oracle::{hausdorff, rational};

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

/// A target must be a vector of moments; the first one published is on the boundary, a single pair of surfaces at both ends.
#[test]
fn targets_are_moments() {
    let biases = published_biases();
    assert_eq!(biases.len(), 7);
    for bias in &biases {
        let moments: Vec<_> = bias.target.iter().map(|&b| rational(b).unwrap()).collect();
        let [low, high] = bias.interval.map(|end| rational(end).unwrap());
        let middle = rational(0.5 * (bias.interval[0] + bias.interval[1])).unwrap();
        let extremal = hausdorff(&moments, [&low, &high], &middle).unwrap();
        let halves = bias.target.iter().all(|&b| b == 0.5);
        // (0, beta, 0, beta) are moments of both ends and the middle, the only such ones on the interval.
        let planes = bias.interval[0] < 0.0;
        assert_eq!(
            extremal.unique,
            halves || planes,
            "{} by {}",
            bias.name,
            bias.source
        );
        assert_eq!(
            extremal.points.len(),
            if halves { 2 } else { extremal.points.len() }
        );
    }
    let alphas: Vec<f64> = biases.iter().map(|bias| bias.alpha).collect();
    assert_eq!(alphas, [2e-6, 3e-5, 3e-5, 4e-3, 6e-5, 3e-7, 6e-5]);
}

#[test]
fn all_choices_of_bases_are_ranked_the_same_each_time() {
    let one = Subsets::evaluate(3, 0.0, 7, || ()).unwrap();
    assert_eq!(one.ranked.len() as u64, Subsets::COUNT);
    assert_eq!(one.receivers, 24);
    assert!(one.ranked.is_sorted_by(|a, b| a.mean_error <= b.mean_error));
    // Lower bounds do not exceed the truth, and four functions tell something.
    assert!(
        one.ranked
            .iter()
            .all(|subset| (0.0..0.5).contains(&subset.mean_error))
    );
    for indices in [Subsets::POWERS, Subsets::TRIGONOMETRIC] {
        let (rank, subset) = one.rank(indices).unwrap();
        assert_eq!(one.ranked[rank - 1], *subset);
        println!("{rank}: {}, {}", subset.name, subset.mean_error);
    }
    let threads = rayon::ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .unwrap();
    assert_eq!(
        threads.install(|| Subsets::evaluate(3, 0.0, 7, || ()).unwrap()),
        one
    );
}

/// On a circle both ends of the depth range are one point.
#[test]
fn a_margin_favours_trigonometric_functions() {
    let advantage = |margin| {
        let subsets = Subsets::evaluate(20, margin, 8, || ()).unwrap();
        let error = |indices| subsets.rank(indices).unwrap().1.mean_error;
        error(Subsets::POWERS) / error(Subsets::TRIGONOMETRIC)
    };
    let [without, with] = [0.0, 0.2].map(advantage);
    assert!(with > 1.2 * without, "{without} {with}");
}

#[test]
fn the_histogram_is_saved_or_the_reason_told() {
    let folder = tempfile::tempdir().unwrap();
    let (subsets, files) = bases::run(&folder.path().join("new"), 1, 0.0).unwrap();
    let svg = std::fs::read_to_string(&files[0]).unwrap();
    let (rank, powers) = subsets.rank(Subsets::POWERS).unwrap();
    assert!(svg.contains(&format!("rank {rank}")) && svg.contains(&powers.name));
    let png = image::open(&files[1]).unwrap();
    assert_eq!([png.width(), png.height()], [1000, 560]);
    let taken = folder.path().join("taken");
    std::fs::write(&taken, "").unwrap();
    let error = bases::run(&taken, 1, 0.0).unwrap_err();
    assert!(matches!(error, BasesError::Folder { .. }));
    assert!(error.to_string().contains("taken"));
    for margin in [-0.1, 0.5, f64::NAN] {
        let error = Subsets::evaluate(1, margin, 7, || ()).unwrap_err();
        assert!(matches!(error, SubsetError::Margin(_)));
    }
    assert!(matches!(
        bases::run(&folder.path().join("none"), 0, 0.0),
        Err(BasesError::Subsets(SubsetError::NoSamples))
    ));
}
