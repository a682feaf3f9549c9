//! Convolution shadow maps: the series, its table of overshoots, and a lower bound.

use std::f64::consts::PI;

use moment_shadows::{Profile, Storage};
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::HALF_ULP;
use crate::mixture::{self, Input, UNORM8};

const TABLE: &str = "
import moment_shadows::techniques::convolution::{CONVOLUTION_DAMPING, convolution_bound};

alias BatchInput = vec4u;
alias BatchOutput = vec4f;

fn batch(terms: BatchInput) -> BatchOutput {
    return vec4f(convolution_bound(terms.x), CONVOLUTION_DAMPING, 0.0);
}
";

/// Shift, overshoot and damping for 1 to 16 terms.
fn table() -> Vec<[f64; 3]> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let terms: Vec<[u32; 4]> = (1..=16).map(|terms| [terms; 4]).collect();
    let found: Vec<[f32; 4]> = Batch::new(&gpu, "table", TABLE)
        .unwrap()
        .run(&terms)
        .unwrap();
    found
        .into_iter()
        .map(|[shift, overshoot, damping, _]| [shift, overshoot, damping].map(f64::from))
        .collect()
}

/// Amplitude and frequency of the damped terms.
fn terms(count: u32, damping: f64) -> impl Iterator<Item = (f64, f64)> {
    (1..=count).map(move |k| {
        let frequency = PI * f64::from(2 * k - 1);
        let share = f64::from(k) / f64::from(count);
        (
            2.0 * (-damping * share * share).exp() / frequency,
            frequency,
        )
    })
}

fn series(difference: f64, count: u32, damping: f64) -> f64 {
    let sum: f64 = terms(count, damping)
        .map(|(amplitude, frequency)| amplitude * (frequency * difference).sin())
        .sum();
    0.5 + sum
}

#[test]
fn the_table_holds_the_largest_overshoots() {
    const STEPS: u32 = 100_000;
    for (count, [shift, overshoot, damping]) in (1..).zip(table()) {
        // f(-t) = 1 - f(t) = f(t - 1): the maximum over [shift - 1, -shift] is that over [-1/2, -shift].
        let samples = || {
            (0..=STEPS).map(|step| {
                let share = f64::from(step) / f64::from(STEPS);
                series(-shift - share * (0.5 - shift), count, damping)
            })
        };
        let in_front = samples().fold(f64::MIN, f64::max);
        // Above 1 by as much as below 0.
        let above = (0..=STEPS)
            .map(|step| -series(-0.5 * f64::from(step) / f64::from(STEPS), count, damping))
            .fold(f64::MIN, f64::max);
        let found = in_front.max(above);
        println!("{count:>2} terms: shift {shift:.4}, overshoot {overshoot:.4}, found {found:.6}");
        // Rounded up in the fourth digit, the shift as well.
        assert!(found <= overshoot + 1e-7 && overshoot - found < 2.5e-4);
    }
}

/// The series of an input in f64, as a lower bound or plain.
fn exact(input: &Input, [shift, overshoot, damping]: [f64; 3], lower_bound: bool) -> f64 {
    let place = |depth: f64| (0.5 * depth + 0.5) * (1.0 - 2.0 * shift);
    let [moved, less] = if lower_bound {
        [shift, overshoot]
    } else {
        [0.0; 2]
    };
    let receiver = place(f64::from(input.fragment_depth)) - moved;
    let mean = input.mean(|depth| series(receiver - place(depth), input.terms, damping));
    (mean - less).clamp(0.0, 1.0)
}

#[test]
fn intensities_are_the_series_and_the_lower_bound_is_one() {
    let table = table();
    let storages = [
        (Storage::Unorm16.wgsl_index(), 1.0 / 65535.0),
        (Storage::Float16.wgsl_index(), 1.0 / f64::from(1 << 12)),
        (Storage::Float32.wgsl_index(), 0.0),
        (UNORM8, 1.0 / 255.0),
    ];
    for (storage, rounding) in storages {
        let mut random = ChaCha8Rng::seed_from_u64(2007);
        let inputs: Vec<Input> = (0..40_000)
            .map(|_| {
                let mut input = mixture::random(&mut random, Storage::Float32);
                input.storage = storage;
                input.terms = random.random_range(1..=16);
                input
            })
            .collect();
        let mut largest = 0.0_f64;
        for (input, output) in inputs.iter().zip(mixture::run(&inputs)) {
            let bound = table[input.terms as usize - 1];
            // sin(a) C - cos(a) S with errors of C and S: sqrt(2) times theirs. WGSL's own sines and cosines are accurate to 2^-11
            // each; this adapter's, to some units of the last place of an argument up to pi.
            let each = rounding + 40.0 * HALF_ULP;
            let sum: f64 = terms(input.terms, bound[2]).map(|term| term.0).sum();
            let tolerance = 2.0_f64.sqrt() * each * sum + 16.0 * HALF_ULP
                // The angle's error: 2 k - 1 half turns, of numbers up to 31.
                + terms(input.terms, bound[2]).map(|(a, f)| a * f * 8.0 * HALF_ULP).sum::<f64>();
            let cases = [
                (output.convolution, true),
                (output.convolution_series, false),
            ];
            for (found, lower_bound) in cases {
                let exact = exact(input, bound, lower_bound);
                let error = (f64::from(found) - exact).abs();
                assert!(
                    error <= tolerance,
                    "storage {storage}: {input:?} gave {found} instead of {exact}, beyond {tolerance:e}"
                );
                largest = largest.max(error);
            }
            assert!(
                f64::from(output.convolution) <= input.truth() + tolerance,
                "storage {storage}: {input:?} gave {}",
                output.convolution
            );
        }
        println!("storage {storage}: off by {largest:.1e} at most");
    }
}

/// More terms make a sharper step: full shadow and full light farther from the occluder read as such.
#[test]
fn more_terms_are_sharper() {
    let intensity = |terms: u32, fragment: f32| {
        let mut input = Input::new(&[(0.0, 1.0)], fragment, Storage::Float32);
        input.terms = terms;
        f64::from(mixture::run(&[input])[0].convolution)
    };
    // Twice the shift behind the occluder, of depths that span 2.
    for (terms, behind) in [(4, 1.0), (8, 0.35), (16, 0.15)] {
        let found = intensity(terms, behind);
        println!("{terms} terms: {found:.3} at {behind} behind the occluder");
        assert!(found > 0.9);
        assert_eq!(intensity(terms, 0.0), 0.0);
    }
}
