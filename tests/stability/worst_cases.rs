//! Inputs that the stability report found to be the worst, and what each showed.
//!
//! Kernels are those of `stability::kernels`: a Gaussian and a box of 3, 5, 9, 17, 25, 33, 65 and 129 texels, in this order.

use moment_shadows::{Profile, Storage};
use moment_shadows_lab::command::stability::pairs;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::stability::input::Input;
use moment_shadows_lab::stability::kernels::NARROW;
use moment_shadows_lab::stability::limits::allowed_excess;
use moment_shadows_lab::stability::shader::Evaluator;
use moment_shadows_lab::stability::strata::Stratum;
use moment_shadows_lab::stability::truth::truth;
use moment_shadows_lab::techniques::label;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// The worst input of every technique and storage on either driver: rows of `stability.json`, whose words are those of [`Input`].
#[test]
fn what_long_runs_found_is_within_what_is_allowed() {
    let rows: Vec<serde_json::Value> =
        serde_json::from_str(include_str!("worst_inputs.json")).unwrap();
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let mut seen = 0;
    for pair in pairs(None, None).unwrap() {
        let name = label(pair.technique());
        let of_pair = |row: &&serde_json::Value| {
            row["technique"] == name && row["storage"] == pair.storage().name()
        };
        let inputs: Vec<Input> = rows
            .iter()
            .filter(of_pair)
            .map(|row| serde_json::from_value(row["input"].clone()).unwrap())
            .collect();
        assert!(!inputs.is_empty(), "{pair}");
        seen += inputs.len();
        let evaluator = Evaluator::new(&gpu, &pair).unwrap();
        for (input, found) in inputs.iter().zip(evaluator.run(&inputs).unwrap()) {
            assert!(
                (0.0..=1.0).contains(&found),
                "{pair}: {input:?} gave {found}"
            );
            let excess = f64::from(found) - truth(input, evaluator.kernels()).unwrap();
            let allowed = match (name.as_str(), pair.storage()) {
                // Biases cover all but one filter region in 100,000, and these are some of 100 million.
                ("hamburger4", Storage::Unorm16 | Storage::Float16) => 0.11,
                ("hausdorff4", Storage::Unorm16) => 0.03,
                _ => allowed_excess(&pair, input.kernel >= NARROW),
            };
            assert!(
                excess <= allowed,
                "{name} {}: {excess:.3e} of {input:?}",
                pair.storage()
            );
        }
    }
    assert_eq!(seen, rows.len());
}

/// By how much each result is above the truth.
fn excesses(technique: &str, storage: &str, inputs: &[Input]) -> Vec<f64> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let pairs = pairs(Some(technique), Some(storage)).unwrap();
    let evaluator = Evaluator::new(&gpu, &pairs[0]).unwrap();
    let found = evaluator.run(inputs).unwrap();
    let results = inputs.iter().zip(found);
    results
        .map(|(input, found)| {
            assert!((0.0..=1.0).contains(&found), "{input:?} gave {found}");
            f64::from(found) - truth(input, evaluator.kernels()).unwrap()
        })
        .collect()
}

fn excess(technique: &str, storage: &str, input: Input) -> f64 {
    let excess = excesses(technique, storage, &[input])[0];
    println!("{technique} {storage}: {excess:.3e}");
    excess
}

/// 5.8e-3: three roundings to 8 bits of each of eight sines and cosines, of which the overshoot that is subtracted takes most.
#[test]
fn convolution_unorm8_at_the_near_end_of_both_ends() {
    let input = Input {
        depths: [0.9974028, -1.0, 1.0, -1.0, 0.0, 0.0, 0.0, 0.0],
        fragment_depth: -1.0,
        kind: Input::PATCH,
        count: 4,
        kernel: 13,
        coverage: 1,
        column: 864592549,
        row_run: 48,
        column_run: 48,
        rows: [3139548736, 447942958],
        ..Input::default()
    };
    // sqrt(2) 3 / 255 times the sum of the amplitudes, 1.13.
    assert!(excess("convolution", "unorm8", input) <= 0.019);
}

/// 8.6e-4: three roundings to 10 bits, all to one side, next to the far end. They need a moment bias of 6e-3; with 5.5e-3 the bound
/// exceeds the truth by 2.7e-2, five times the bias.
#[test]
fn hamburger6_unorm10_at_the_nearer_of_two_surfaces() {
    let input = Input {
        depths: [-0.0322779, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0, 0.0],
        fragment_depth: -0.0322779,
        kind: Input::PATCH,
        count: 4,
        kernel: 6,
        coverage: 3,
        column: 192051881,
        row_run: 16,
        column_run: 16,
        rows: [3124121443, 400663941],
        ..Input::default()
    };
    let bias = moment_shadows::Storage::Unorm10.six_moments_bias().unwrap();
    assert!(excess("hamburger6", "unorm10", input) <= f64::from(bias.alpha));
}

/// 2.9e-3: one rounding of e^(3 (z - 1)) at the near end of the light's range, where it is smallest.
#[test]
fn esm_unorm16_at_the_near_end() {
    let input = Input {
        depths: [-0.9999336, -0.69766235, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        weights: [0.99998593, 1.4053206e-5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        fragment_depth: -0.9999336,
        count: 2,
        ..Input::default()
    };
    // One of three roundings that darken by 1 % together.
    assert!(excess("esm", "unorm16", input) <= 0.01 / 3.0);
}

/// 3.4e-3: three roundings of the logarithm, times the exponent 13.6.
#[test]
fn esm_logarithmic_float16_between_both_ends() {
    let input = Input {
        depths: [-0.6993029, 1.0, 1.0, -1.0, -0.77667654, 0.0, 0.0, 0.0],
        fragment_depth: 1.0,
        kind: Input::PATCH,
        count: 5,
        kernel: 3,
        column: 1234114044,
        column_run: 3,
        rows: [4049925804, 1965929470],
        ..Input::default()
    };
    assert!(excess("esm_logarithmic", "float16", input) <= 0.01);
}

/// 0.080: surfaces 0.019 apart, whose variance of 8.6e-5 a rounding takes a third of. A loss of 1.1e-4 against a smallest
/// variance of 6e-5 moves the bound by 0.27.
#[test]
fn vsm_unorm16_with_two_surfaces_as_close_as_rounding() {
    let input = Input {
        depths: [-0.8980899, -0.917066, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        weights: [0.6045188, 0.3954812, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        fragment_depth: -0.8980899,
        count: 2,
        ..Input::default()
    };
    assert!(excess("vsm", "unorm16", input) <= 0.27);
}

/// 0.088: the same of a layer, at a split between two.
#[test]
fn lvsm_float16_with_surfaces_as_close_as_rounding() {
    let input = Input {
        depths: [
            -0.01879799,
            0.004455078,
            0.004568136,
            -0.024734953,
            -0.0006004038,
            0.0,
            0.0,
            0.0,
        ],
        fragment_depth: 0.004568136,
        kind: Input::PATCH,
        count: 5,
        kernel: 7,
        column: 2810481267,
        row_run: 129,
        rows: [2816383268, 2581246108],
        ..Input::default()
    };
    assert!(excess("lvsm", "float16", input) <= 0.27);
}

/// 0.081: two surfaces 0.02 apart in the middle of the range, where a warp of 1 has a step of 2^-10.
#[test]
fn evsm2_float16_with_surfaces_as_close_as_rounding() {
    let input = Input {
        depths: [
            -0.014175307,
            0.0109454505,
            -0.08403061,
            0.058648158,
            -0.006137148,
            0.014139448,
            0.0,
            0.0,
        ],
        weights: [
            0.00061964616,
            1.1257788e-8,
            1.9478088e-5,
            3.882725e-6,
            0.45640367,
            0.5429533,
            0.0,
            0.0,
        ],
        fragment_depth: 0.014139448,
        count: 6,
        ..Input::default()
    };
    assert!(excess("evsm2", "float16", input) <= 0.29);
}

/// 0.087: the same of the negative warp.
#[test]
fn evsm4_float16_with_surfaces_as_close_as_rounding() {
    let input = Input {
        depths: [
            3.068626e-7,
            0.00018934945,
            -1.3665753e-9,
            2.4893437e-10,
            -0.027145417,
            0.0,
            0.0,
            0.0,
        ],
        weights: [
            0.3791681,
            0.33158842,
            0.01649986,
            0.025064362,
            0.24767926,
            0.0,
            0.0,
            0.0,
        ],
        fragment_depth: -1.3665753e-9,
        count: 5,
        ..Input::default()
    };
    assert!(excess("evsm4", "float16", input) <= 0.29);
}

/// 1.11e-3: one surface and a fragment on it. The bias has put a share of 1.5e-3 in front.
#[test]
fn hausdorff4_float16_at_its_only_surface() {
    let input = Input {
        depths: [0.9868865, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        weights: [1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        fragment_depth: 0.9868865,
        ..Input::default()
    };
    assert!(excess("hausdorff4", "float16", input) <= 1.5e-3);
}

/// 6.8e-5: a slight share in front of the far end, and the bias.
#[test]
fn hausdorff4_unorm16_at_the_far_end() {
    let input = Input {
        depths: [1.0, -0.9989339, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0],
        weights: [
            0.5857359,
            0.0024341166,
            0.40658814,
            0.003968562,
            0.0006415328,
            1.4678878e-6,
            0.00063026004,
            0.0,
        ],
        fragment_depth: 1.0,
        count: 7,
        ..Input::default()
    };
    assert!(excess("hausdorff4", "unorm16", input) <= 8e-5);
}

/// 5e-5: a slight share in front of one surface, and the bias.
#[test]
fn hamburger4_unorm16_behind_a_slight_share() {
    let input = Input {
        depths: [0.36614776, 0.9822048, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        weights: [0.0020962683, 0.9979037, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        fragment_depth: 0.9822048,
        count: 2,
        ..Input::default()
    };
    assert!(excess("hamburger4", "unorm16", input) <= 6e-5);
}

/// Two surfaces 1.3e-4 apart under 129 equal weights, in a map that hardly varies: sums of f32 are off by 2e-6 in each pass.
fn wide_box() -> Input {
    Input {
        depths: [-1.34803095e-5, -0.00014312046, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        fragment_depth: -1.34803095e-5,
        kind: Input::PATCH,
        count: 2,
        kernel: 15,
        column: 3309075253,
        row_run: 129,
        rows: [2013255775, 4269302524],
        ..Input::default()
    }
}

/// 0.29: the smallest variance of float32 is less than what these sums lose.
#[test]
fn evsm2_float32_under_129_equal_weights() {
    // A loss of 1.5e-5 against a smallest variance of 6e-7, relative to the mean square, moves the bound by 0.68.
    assert!(excess("evsm2", "float32", wide_box()) <= 0.68);
    // As wide as the smallest variance is made for: a loss of 1.1e-6.
    let narrow = Input {
        kernel: 5,
        ..wide_box()
    };
    assert!(excess("evsm2", "float32", narrow) <= 0.26);
}

/// 1.4e-6, and 0.85 where sums are plain ones of f32: a fragment at the far end behind a share of 0.15 at 1e-3 before it.
#[test]
fn hamburger4_float32_under_129_equal_weights() {
    let input = Input {
        depths: [0.9989566, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 0.0],
        fragment_depth: 1.0,
        kind: Input::PATCH,
        count: 5,
        kernel: 15,
        coverage: 3,
        column: 1830725069,
        column_run: 113,
        rows: [655691318, 2546908131],
        ..Input::default()
    };
    assert!(excess("hamburger4", "float32", input) <= 1.5e-6);
}

/// The excess with 129 equal weights on the interval; 0.49 with plain sums.
#[test]
fn hausdorff4_float32_under_129_equal_weights() {
    let input = Input {
        depths: [-0.9366564, -0.947866, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        fragment_depth: -0.9366564,
        kind: Input::PATCH,
        count: 2,
        kernel: 15,
        coverage: 2,
        column: 585817008,
        row_run: 23,
        column_run: 129,
        rows: [3192254445, 455511054],
        ..Input::default()
    };
    assert!(excess("hausdorff4", "float32", input) <= 2.8e-6);
}

/// What is documented of the biases of float32: they cover blurs of any width, whatever the weights.
#[test]
fn the_biases_of_float32_cover_blurs_of_any_width() {
    let mut random = ChaCha8Rng::seed_from_u64(129);
    for stratum in [Stratum::Filtered, Stratum::FilteredWide] {
        let inputs: Vec<Input> = (0..100_000).map(|_| stratum.sample(&mut random)).collect();
        for (technique, alpha) in [("hamburger4", 1.5e-6), ("hausdorff4", 2.8e-6)] {
            let found = excesses(technique, "float32", &inputs);
            let largest = found.into_iter().fold(f64::MIN, f64::max);
            println!("{technique}: {largest:.2e} of {alpha:e}");
            assert!(largest <= alpha);
        }
    }
}
