//! Exponential shadow maps: the value of the formula, a lower bound, and exponents where the storages' ranges put them.

use moment_shadows::Storage;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::HALF_ULP;
use crate::mixture::{self, Input, limits};

/// The module's largest exponents, plain and logarithmic.
pub(crate) fn largest(storage: Storage) -> [f64; 2] {
    match storage {
        Storage::Unorm16 => [3.0, 80.0],
        Storage::Float16 => [9.7, 13.6],
        _ => [80.0, 80.0],
    }
}

/// Relative error of exp(x) for |x| <= 80 in f32 as WGSL demands it, (3 + 2 |x|) units in the last place; of a sum of eight.
fn exp_error(exponent: f64) -> f64 {
    2.0 * (3.0 + 2.0 * exponent) * HALF_ULP + 8.0 * HALF_ULP
}

/// How far one rounding to the storage, and f32 arithmetic, can darken: plain and logarithmic.
fn darkening(storage: Storage, fragment_depth: f64, [plain, logarithmic]: [f64; 2]) -> [f64; 2] {
    let of_plain = match storage {
        // Absolute in a value of e^(c (z - 1)), relative to that of the fragment.
        Storage::Unorm16 => 0.5 / 65535.0 * (plain * (1.0 - fragment_depth)).exp(),
        Storage::Float16 => 1.0 / f64::from(1 << 11),
        _ => 0.0,
    };
    let of_logarithm = match storage {
        Storage::Unorm16 => 1.0 / 65535.0,
        Storage::Float16 => 1.0 / f64::from(1 << 12),
        _ => 0.0,
    };
    [
        of_plain + 4.0 * exp_error(plain),
        // v is the result of a logarithm (3 units), a division and a sum, each up to 1; then multiplied by c.
        logarithmic * (of_logarithm + 8.0 * HALF_ULP) + 4.0 * exp_error(logarithmic),
    ]
}

fn value(input: &Input, exponent: f64) -> f64 {
    let fragment = f64::from(input.fragment_depth);
    (1.0 - input.mean(|depth| (exponent * (depth - fragment)).exp())).max(0.0)
}

#[test]
fn intensities_are_the_clamped_formula_and_a_lower_bound() {
    for storage in Storage::OF_FOUR_MOMENTS {
        let mut random = ChaCha8Rng::seed_from_u64(2008);
        let limits = largest(storage);
        let inputs: Vec<Input> = (0..50_000)
            .map(|index| {
                let mut input = mixture::random(&mut random, storage);
                // Every other one at the limits.
                let share = if index % 2 == 0 {
                    1.0
                } else {
                    random.random_range(0.0..1.0)
                };
                for (exponent, limit) in input.exponents.iter_mut().zip(limits) {
                    *exponent = (1.0 + share * (limit - 1.0)) as f32;
                }
                input
            })
            .collect();
        let mut largest_errors = [0.0_f64; 3];
        for (input, output) in inputs.iter().zip(mixture::run(&inputs)) {
            let exponents = [input.exponents[0], input.exponents[1]].map(f64::from);
            let [plain, logarithmic] =
                darkening(storage, f64::from(input.fragment_depth), exponents);
            // Taps and result are rounded apart.
            let cases = [
                (output.exponential, exponents[0], plain),
                (output.exponential_logarithmic, exponents[1], logarithmic),
                (output.exponential_filtered, exponents[1], 2.0 * logarithmic),
            ];
            for (index, (found, exponent, tolerance)) in cases.into_iter().enumerate() {
                let exact = value(input, exponent);
                let error = f64::from(found) - exact;
                // A relative error of the mean is one of the visibility, which the logarithm's exponential makes.
                let tolerance = tolerance.exp_m1();
                assert!(
                    error.abs() <= tolerance,
                    "{storage}, case {index}: {input:?} gave {found} instead of {exact}, beyond {tolerance:e}"
                );
                assert!(f64::from(found) <= input.truth() + tolerance, "{input:?}");
                largest_errors[index] = largest_errors[index].max(error.abs());
            }
        }
        println!("{storage}: plain, logarithmic, filtered off by {largest_errors:?}");
    }
}

#[test]
fn exponents_are_as_large_as_the_storages_allow() {
    let ln2 = 2.0_f64.ln();
    // From the smallest normal number 2^-k at the near end, with a weight of 2^-10 where numbers below are flushed, and the largest
    // number at the far end.
    let float32 = 116.0 * ln2;
    assert!(float32 < f64::from(f32::MAX).ln());
    let float16 = (14.0 * ln2).min(65504.0_f64.ln());
    // Three roundings darken by 1 %: of e^(c (z - 1)) at the near end, and of v.
    let unorm16 = 0.5 * (0.01 * 65535.0 / 1.5_f64).ln();
    let unorm16_logarithmic: f64 = 0.01 * 65535.0 / 3.0;
    let float16_logarithmic = 0.01 * f64::from(1 << 12) / 3.0;
    let derived = [
        (
            Storage::Unorm16,
            [unorm16, unorm16_logarithmic.min(float32)],
        ),
        (Storage::Float16, [float16, float16_logarithmic]),
        (Storage::Float32, [float32, float32]),
    ];
    for (storage, derived) in derived {
        assert_eq!(
            limits(storage).exponential,
            largest(storage).map(|limit| limit as f32)
        );
        for (limit, derived) in largest(storage).into_iter().zip(derived) {
            println!("{storage}: {limit} of {derived:.3}");
            assert!(limit <= derived && derived - limit < 0.06 * derived.min(8.0));
        }
    }
}

/// At the near end the exponent has the smallest mean, which beyond the limits is lost.
#[test]
fn beyond_its_range_a_storage_loses_the_near_end() {
    let ends = |storage: Storage, exponent: f64| {
        let mut input = Input::new(&[(-1.0, 1.0)], -0.995, storage);
        input.exponents = [exponent as f32; 4];
        let output = mixture::run(&[input])[0];
        (f64::from(output.exponential) - value(&input, exponent)).abs()
    };
    // One surface just in front of the fragment. Half precision has fixed steps of 2^-24 there.
    assert!(ends(Storage::Float16, 9.7) < 2e-3);
    assert!(ends(Storage::Float16, 17.0) > 0.05);
    // 2^-17 in e^(-2 c).
    assert!(ends(Storage::Unorm16, 3.0) < 1e-2);
    assert!(ends(Storage::Unorm16, 6.0) > 0.05);
}
