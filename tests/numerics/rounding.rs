//! The evaluations keep their promise on devices of either kind: those where `fma` rounds once, and those where it rounds twice.
//!
//! WGSL leaves that to the device, and an adapter shows one behaviour only; here the linked text calls functions in place of
//! `fma` that do one and the other.

use std::path::Path;

use bytemuck::Pod;
use moment_shadows::{Profile, Source, Storage, link};
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::oracle::{hausdorff, rational, sensitivity, tolerance_unit};
use moment_shadows_lab::vectors::file::read;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use crate::{HARD_TOLERANCE, Input, TOLERANCE, mixtures, six};

const FOUR: &str = "
import moment_shadows::bounds::hamburger4::{hamburger4_bounds};
struct BatchInput { biased: vec4f, depth: f32, alpha: f32, padding: vec2f }
alias BatchOutput = vec2f;
fn batch(input: BatchInput) -> BatchOutput {
    return hamburger4_bounds(input.biased, input.depth, input.alpha);
}
";

const ON_AN_INTERVAL: &str = "
import moment_shadows::bounds::hausdorff4::{hausdorff4_bounds};
struct BatchInput { biased: vec4f, depth: f32, alpha: f32, padding: vec2f }
alias BatchOutput = vec2f;
fn batch(input: BatchInput) -> BatchOutput {
    return hausdorff4_bounds(input.biased, input.depth, input.alpha);
}
";

const SIX: &str = "
import moment_shadows::bounds::hamburger6::{hamburger6_bounds};
import moment_shadows::moments::six_moments::{SixMoments};
struct BatchInput { odd: vec3f, depth: f32, even: vec3f, alpha: f32 }
alias BatchOutput = vec2f;
fn batch(input: BatchInput) -> BatchOutput {
    return hamburger6_bounds(SixMoments(input.odd, input.even), input.depth, input.alpha);
}
";

/// Once: with the rounding errors of product and sum, by Dekker's and Knuth's exact transformations.
const REPLACEMENTS: &str = "
fn rounded_twice(a: f32, b: f32, c: f32) -> f32 {
    return a * b + c;
}

fn high_half(a: f32) -> f32 {
    let scaled = 4097.0 * a;
    return scaled - (scaled - a);
}

fn rounded_once(a: f32, b: f32, c: f32) -> f32 {
    let product = a * b;
    let high = vec2f(high_half(a), high_half(b));
    let low = vec2f(a, b) - high;
    let product_error = ((high.x * high.y - product) + high.x * low.y + low.x * high.y) + low.x * low.y;
    let sum = product + c;
    let added = sum - product;
    let sum_error = (product - (sum - added)) + (c - added);
    return sum + (sum_error + product_error);
}
";

/// The largest error of the bounds of some published vectors, in units: as the adapter rounds, rounded once and rounded twice. `input` makes an
/// input of moments, depth and alpha.
fn largest_errors<I: Pod>(
    wgsl: &str,
    count: usize,
    alphas: core::ops::Range<f32>,
    input: impl Fn(&[f32], f64, f32) -> I,
) -> [f64; 3] {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/vectors/moment_problem.json");
    let vectors = read(&file).unwrap();
    let vectors = vectors.iter().filter(|vector| vector.m == count);
    let records = vectors
        .flat_map(|vector| &vector.biased)
        .filter(|record| alphas.contains(&(record.alpha as f32)));
    let (inputs, truths): (Vec<I>, Vec<[(f64, f64); 2]>) = records
        .filter_map(|record| {
            let truth = record.hamburger?.both()?;
            let unit = |side: usize| tolerance_unit(record.sens.unwrap()[side].unwrap());
            let moments = record.input().unwrap();
            Some((
                input(&moments, record.depth, record.alpha as f32),
                [(truth[0], unit(0)), (truth[1], unit(1))],
            ))
        })
        .unzip();
    assert!(inputs.len() > 20, "{}", inputs.len());
    let mut largest = [0.0_f64; 3];
    for (largest, found) in largest.iter_mut().zip(each_way(wgsl, &inputs)) {
        for (bounds, truth) in found.iter().zip(&truths) {
            for (bound, (truth, unit)) in bounds.iter().zip(truth) {
                *largest = largest.max((f64::from(*bound) - truth).abs() / unit);
            }
        }
    }
    largest
}

/// The bounds of inputs as the adapter rounds, rounded once and rounded twice.
fn each_way<I: Pod>(wgsl: &str, inputs: &[I]) -> [Vec<[f32; 2]>; 3] {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let linked = link(
        Source {
            name: "rounding.wgsl",
            text: wgsl,
        },
        &[],
    )
    .unwrap();
    ["fma(", "rounded_once(", "rounded_twice("].map(|function| {
        let text = linked.wgsl().replace("fma(", function) + REPLACEMENTS;
        let batch = Batch::<I, [f32; 2]>::new(&gpu, "rounding.wgsl", &text).unwrap();
        let found = batch.run(inputs).unwrap();
        let all = found.as_flattened();
        assert!(all.iter().all(|bound| (0.0..=1.0).contains(bound)));
        found
    })
}

/// The largest error of random inputs in units, each way, and the same of all but one in 10,000.
fn errors<I: Pod + Sync>(
    wgsl: &str,
    inputs: &[I],
    truth: impl Fn(&I) -> ([f64; 2], [f64; 2]) + Sync + Send,
) -> [[f64; 2]; 3] {
    let truths: Vec<_> = inputs.par_iter().map(truth).collect();
    each_way(wgsl, inputs).map(|found| {
        let all = found
            .iter()
            .zip(&truths)
            .flat_map(|(bounds, (exact, units))| {
                [0, 1].map(|side| (f64::from(bounds[side]) - exact[side]).abs() / units[side])
            });
        let mut all: Vec<f64> = all.collect();
        all.sort_by(f64::total_cmp);
        [all[all.len() - 1], all[all.len() - 1 - all.len() / 10_000]]
    })
}

/// Alpha begins at 3e-7 here. Fused, fewer digits are lost.
#[test]
fn fused_or_not_random_distributions_are_within_tolerance() {
    let four = errors(FOUR, &crate::random_inputs(500), crate::truth);
    println!("four moments: {four:.2?} units");
    for [largest, most] in four {
        assert!(largest <= HARD_TOLERANCE && most <= TOLERANCE, "{four:?}");
    }
    let inputs = six::random_inputs(100);
    for is_fine in [true, false] {
        let of_tolerance: Vec<six::Input> = inputs
            .iter()
            .filter(|input| (input.alpha < 5e-5) == is_fine)
            .copied()
            .collect();
        let tolerance = six::tolerance(of_tolerance[0].alpha);
        let six = errors(SIX, &of_tolerance, |input| six::truth(input, 6));
        println!("six moments: {six:.2?} units of {tolerance}");
        assert!(
            six.iter().all(|[largest, _]| *largest <= tolerance),
            "{six:?}"
        );
    }
}

/// Random distributions with the moment biases of Hausdorff bounds, which leave moments inside of those on [-1, 1].
fn on_an_interval(each: usize) -> Vec<Input> {
    let mut inputs = Vec::new();
    for (class, seed) in mixtures::CLASSES.iter().zip(2015..) {
        for storage in Storage::OF_FOUR_MOMENTS {
            let bias = storage.hausdorff_moment_bias();
            let [alpha, second, fourth] = [bias.alpha, bias.second, bias.fourth].map(f64::from);
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            for _ in 0..each {
                let sample = mixtures::sample(class, &mut random);
                let moments = mixtures::moments::<4>(&sample.atoms);
                let targets = [0.0, second, 0.0, fourth];
                let biased = [0, 1, 2, 3]
                    .map(|index| moments[index] + alpha * (targets[index] - moments[index]));
                let biased = biased.map(|moment| moment as f32);
                let depth = sample
                    .from_gauss_node
                    .map(|distance| mixtures::gauss_node(biased, distance > 0.0) + distance);
                let depth = depth.unwrap_or(sample.fragment_depth).clamp(-1.0, 1.0);
                inputs.push(Input::new(biased, depth, alpha));
            }
        }
    }
    inputs
}

#[test]
fn fused_or_not_random_distributions_on_an_interval_are_within_tolerance() {
    let truth = |input: &Input| {
        let exact = |value: f32| rational(f64::from(value)).unwrap();
        let (moments, depth) = (input.biased.map(exact), exact(input.depth));
        let extremal = hausdorff(&moments, [&exact(-1.0), &exact(1.0)], &depth).unwrap();
        let sensitivity = sensitivity(&moments, &depth, &extremal).unwrap();
        (
            [extremal.lower, extremal.upper],
            sensitivity.map(tolerance_unit),
        )
    };
    let found = errors(ON_AN_INTERVAL, &on_an_interval(500), truth);
    println!("four moments on an interval: {found:.2?} units");
    for [largest, most] in found {
        assert!(largest <= HARD_TOLERANCE && most <= TOLERANCE, "{found:?}");
    }
}

#[test]
fn fused_or_not_the_published_vectors_are_within_tolerance() {
    let four = |moments: &[f32], depth: f64, alpha: f32| {
        Input::new(moments.try_into().unwrap(), depth, f64::from(alpha))
    };
    let errors = largest_errors(FOUR, 4, 0.0..1.0, four);
    println!("four moments: {errors:.2?} units");
    assert!(errors.iter().all(|&error| error <= TOLERANCE), "{errors:?}");
    let input = |moments: &[f32], depth: f64, alpha: f32| {
        six::Input::new(moments.try_into().unwrap(), depth, alpha)
    };
    for alphas in [0.0..5e-5, 5e-5..1.0] {
        let tolerance = six::tolerance(alphas.start);
        let errors = largest_errors(SIX, 6, alphas, input);
        println!("six moments: {errors:.2?} units of {tolerance}");
        assert!(errors.iter().all(|&error| error <= tolerance), "{errors:?}");
    }
}
