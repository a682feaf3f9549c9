//! Six moments: the shader's bounds against the exact ones, against those of four moments, and on invalid moments.

use bytemuck::{Pod, Zeroable};
use moment_shadows::{Profile, SixMomentsBias, Storage, Technique};
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::oracle::{Mixture, hamburger, rational, sensitivity, tolerance_unit};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rayon::prelude::*;

use super::mixtures;

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct Input {
    odd: [f32; 3],
    pub(crate) depth: f32,
    even: [f32; 3],
    pub(crate) alpha: f32,
}

impl Input {
    pub(crate) fn new(moments: [f32; 6], depth: f64, alpha: f32) -> Self {
        Self {
            odd: [0, 2, 4].map(|index: usize| moments[index]),
            depth: depth as f32,
            even: [1, 3, 5].map(|index: usize| moments[index]),
            alpha,
        }
    }

    pub(crate) fn moments(&self) -> [f32; 6] {
        let ([b1, b3, b5], [b2, b4, b6]) = (self.odd, self.even);
        [b1, b2, b3, b4, b5, b6]
    }
}

/// Lower and upper bound, the lower one by the way that shading takes, and shadow intensity from texels of float32 whose channels are
/// the input's numbers.
pub(crate) fn bounds(inputs: &[Input]) -> Vec<[f32; 4]> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    Batch::new(&gpu, "six.wgsl", include_str!("six.wgsl"))
        .unwrap()
        .run(inputs)
        .unwrap()
}

/// The exact bounds of an input by its first `count` moments, and the units of their errors.
pub(crate) fn truth(input: &Input, count: usize) -> ([f64; 2], [f64; 2]) {
    let moments: Vec<_> = input.moments()[..count]
        .iter()
        .map(|&moment| rational(f64::from(moment)).unwrap())
        .collect();
    let depth = rational(f64::from(input.depth)).unwrap();
    let extremal = hamburger(&moments, &depth).unwrap();
    let units = sensitivity(&moments, &depth, &extremal)
        .unwrap()
        .map(tolerance_unit);
    ([extremal.lower, extremal.upper], units)
}

/// How many units of 2^-24 (1 + sensitivity) an error may be: there are about three dozen roundings in a row where four
/// moments have a dozen, and below an alpha of 5e-5 the last pivot has lost so many digits that they weigh more.
pub(crate) fn tolerance(alpha: f32) -> f64 {
    if alpha >= 5e-5 { 32.0 } else { 128.0 }
}

/// The biases of the storages, and the published one of float32 without a basis.
fn biases() -> Vec<SixMomentsBias> {
    let published = SixMomentsBias {
        even: [0.48, 0.451, 0.45],
        alpha: 5e-6,
    };
    Technique::Hamburger6
        .row()
        .storages
        .iter()
        .map(|storage| storage.six_moments_bias().unwrap())
        .chain([published])
        .collect()
}

pub(crate) fn biased(moments: [f64; 6], bias: &SixMomentsBias) -> [f32; 6] {
    core::array::from_fn(|index| {
        let target = if index % 2 == 1 {
            f64::from(bias.even[index / 2])
        } else {
            0.0
        };
        (moments[index] + f64::from(bias.alpha) * (target - moments[index])) as f32
    })
}

/// A Gauss node of moments: a root of the third orthogonal polynomial, by halving between its extremes and the interval's ends.
fn gauss_node(moments: [f32; 6], which: usize) -> f64 {
    let [b1, b2, b3, b4, b5, _] = moments.map(f64::from);
    let variance = b2 - b1 * b1;
    let covariance = b3 - b1 * b2;
    let slope = covariance / variance;
    let residue = b4 - b2 * b2 - covariance * slope;
    let fourth = b5 - b2 * b3 - covariance * (b4 - b1 * b3) / variance;
    let offset = fourth / residue - slope - b1;
    let second = |x: f64| x * (x - slope + 2.0 * b1) - variance;
    let third = |x: f64| (x - offset) * second(x) - residue / variance * x;
    // The nodes interlace with the roots of the second polynomial.
    let half = 0.5 * (slope - 2.0 * b1);
    let root = (half * half + variance).sqrt();
    let places = [-3.0, half - root, half + root, 3.0];
    let [mut low, mut high] = [places[which], places[which + 1]];
    let sign = third(low) > 0.0;
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if (third(middle) > 0.0) == sign {
            low = middle;
        } else {
            high = middle;
        }
    }
    b1 + 0.5 * (low + high)
}

/// So many inputs of each class with each bias.
pub(crate) fn random_inputs(each: usize) -> Vec<Input> {
    let mut inputs = Vec::new();
    for (index, class) in mixtures::CLASSES.iter().enumerate() {
        for bias in biases() {
            let mut random = ChaCha8Rng::seed_from_u64(2016 + index as u64);
            for _ in 0..each {
                let sample = mixtures::sample(class, &mut random);
                let biased = biased(mixtures::moments(&sample.atoms), &bias);
                let depth = sample
                    .from_gauss_node
                    .map_or(sample.fragment_depth, |distance| {
                        gauss_node(biased, random.random_range(0..3)) + distance
                    });
                inputs.push(Input::new(biased, depth, bias.alpha));
            }
        }
    }
    inputs
}

#[test]
fn random_distributions_are_within_tolerance_and_never_looser_than_with_four_moments() {
    const EACH: usize = 100;
    let inputs = random_inputs(EACH);
    let outputs = bounds(&inputs);
    let errors: Vec<f64> = inputs
        .par_iter()
        .zip(&outputs)
        .map(|(input, output)| {
            let (exact, units) = truth(input, 6);
            let [lower, upper, shading, _] = *output;
            assert!(
                0.0 <= lower && lower <= upper && upper <= 1.0,
                "{input:?} gave {output:?}"
            );
            let found = [lower, upper, shading].map(f64::from);
            let ([loose_lower, loose_upper], _) = truth(input, 4);
            let allowed = units.map(|unit| tolerance(input.alpha) * unit);
            assert!(found[0] >= loose_lower - allowed[0], "{input:?}");
            assert!(found[1] <= loose_upper + allowed[1], "{input:?}");
            // Shading takes depths beyond the light's range for its ends.
            let shading = if input.depth.abs() <= 1.0 {
                found[2]
            } else {
                found[0]
            };
            [(found[0], 0), (found[1], 1), (shading, 0)]
                .map(|(value, side)| (value - exact[side]).abs() / allowed[side])
                .into_iter()
                .fold(0.0, f64::max)
        })
        .collect();
    let biases = biases();
    for (class, errors) in mixtures::CLASSES
        .iter()
        .zip(errors.chunks(EACH * biases.len()))
    {
        for (bias, errors) in biases.iter().zip(errors.chunks(EACH)) {
            let mut errors = errors.to_vec();
            errors.sort_by(f64::total_cmp);
            println!(
                "{class:<26} alpha {:.1e}  median {:5.3}  largest {:5.3} of the tolerance",
                bias.alpha,
                errors[EACH / 2],
                errors[EACH - 1]
            );
        }
    }
    let beyond = errors.iter().filter(|&&error| error > 1.0).count();
    assert_eq!(beyond, 0, "of {}", errors.len());
}

#[test]
fn bounds_rise_with_depth_and_stay_on_their_side_of_the_truth() {
    const EACH: usize = 4;
    const DEPTHS: usize = 33;
    let mut inputs = Vec::new();
    let mut samples = Vec::new();
    let mut random = ChaCha8Rng::seed_from_u64(6);
    for class in mixtures::CLASSES {
        for bias in biases() {
            for _ in 0..EACH {
                let sample = mixtures::sample(class, &mut random);
                let biased = biased(mixtures::moments(&sample.atoms), &bias);
                let surface = sample.atoms[0].0;
                let mut depths: Vec<f64> = (0..DEPTHS)
                    .map(|_| {
                        if random.random() {
                            random.random_range(-1.0..=1.0)
                        } else {
                            let sign = if random.random() { 1.0 } else { -1.0 };
                            surface + sign * 10.0_f64.powf(random.random_range(-6.0..0.0))
                        }
                    })
                    .collect();
                depths.sort_by(f64::total_cmp);
                inputs.extend(
                    depths
                        .iter()
                        .map(|&depth| Input::new(biased, depth, bias.alpha)),
                );
                samples.push((sample, bias));
            }
        }
    }
    let outputs = bounds(&inputs);
    samples
        .par_iter()
        .zip(inputs.par_chunks(DEPTHS))
        .zip(outputs.par_chunks(DEPTHS))
        .for_each(|(((sample, bias), inputs), outputs)| {
            let mixture = Mixture::new(&sample.atoms).unwrap();
            // The true tolerance is derived from the exact bounds only where the smallest one does not settle the matter.
            let least = tolerance(bias.alpha) / f64::from(1 << 24);
            let allowed = |index: usize| {
                let units = truth(&inputs[index], 6).1;
                tolerance(bias.alpha) * units[0].max(units[1])
            };
            for index in 0..DEPTHS {
                let (input, [lower, upper, ..]) = (&inputs[index], outputs[index].map(f64::from));
                assert!(0.0 <= lower && lower <= upper && upper <= 1.0, "{input:?}");
                if index > 0 {
                    let fall = f64::from(outputs[index - 1][0]) - lower;
                    assert!(
                        fall <= least || fall <= allowed(index - 1) + allowed(index),
                        "the lower bound falls by {fall} at {input:?}"
                    );
                }
                // The share alpha of the biased distribution may lie anywhere. The mixture's moments were rounded to f32 once,
                // which moves the bounds by one more unit at most.
                let depth = rational(f64::from(input.depth)).unwrap();
                let excess = (lower - mixture.below(&depth))
                    .max(mixture.at_or_below(&depth) - upper)
                    - f64::from(bias.alpha);
                assert!(
                    excess <= least || excess <= 1.1 * allowed(index),
                    "the truth is out of the bounds by {excess} at {input:?}"
                );
            }
        });
}

/// Three surfaces are the only distribution with their six moments. The bias leaves a doubt: the weight that the fragment can
/// have, which is at most E[p^2] / p(fragment)^2 for any cubic p; with p = 0 at the surfaces that is alpha times what the bias' target
/// alone gives.
#[test]
fn up_to_three_surfaces_are_reproduced() {
    const SAMPLES: usize = 500;
    let bias = Storage::Float32.six_moments_bias().unwrap();
    let alpha = f64::from(bias.alpha);
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let mut inputs = Vec::new();
    let mut expected = Vec::new();
    while inputs.len() < SAMPLES {
        let count = random.random_range(1..=3);
        let atoms: Vec<(f64, f64)> = (0..count)
            .map(|_| {
                (
                    random.random_range(-1.0..=1.0),
                    random.random_range(0.05..=1.0),
                )
            })
            .collect();
        let depth: f64 = random.random_range(-1.0..=1.0);
        let root = |index: usize| atoms.get(index).map_or(0.0, |atom| atom.0);
        // Coefficients of (z - r0) (z - r1) (z - r2), those of its square, and its expectation under the target.
        let (r0, r1, r2) = (root(0), root(1), root(2));
        let cubic = [
            -r0 * r1 * r2,
            r0 * r1 + r0 * r2 + r1 * r2,
            -(r0 + r1 + r2),
            1.0,
        ];
        let target = [1.0, 0.0, bias.even[0], 0.0, bias.even[1], 0.0, bias.even[2]].map(f64::from);
        let mut mean_square = 0.0;
        for (i, a) in cubic.iter().enumerate() {
            for (j, b) in cubic.iter().enumerate() {
                mean_square += a * b * target[i + j];
            }
        }
        let at_fragment = (depth - r0) * (depth - r1) * (depth - r2);
        let doubt = alpha * mean_square / (at_fragment * at_fragment);
        if doubt > 1e-2 {
            continue;
        }
        let below: f64 = atoms
            .iter()
            .filter(|atom| atom.0 < depth)
            .map(|atom| atom.1)
            .sum();
        let sum: f64 = atoms.iter().map(|atom| atom.1).sum();
        let input = Input::new(biased(mixtures::moments(&atoms), &bias), depth, bias.alpha);
        inputs.push(input);
        expected.push((below / sum, alpha + doubt, count));
    }
    let mut missed_by_four: f64 = 0.0;
    for ((input, output), (truth_of_surfaces, doubt, count)) in
        inputs.iter().zip(bounds(&inputs)).zip(&expected)
    {
        let ([four, _], _) = truth(input, 4);
        let (_, units) = truth(input, 6);
        let tolerance = doubt + tolerance(input.alpha) * units[0].max(units[1]);
        for value in [output[0], output[1]] {
            let error = (f64::from(value) - truth_of_surfaces).abs();
            assert!(
                error <= tolerance,
                "{count} surfaces, {input:?}: {error:.1e} > {tolerance:.1e}"
            );
        }
        missed_by_four = missed_by_four.max(truth_of_surfaces - four);
    }
    // Four moments reproduce two surfaces only.
    assert!(missed_by_four > 0.3, "{missed_by_four}");
}

#[test]
fn whatever_is_finite_gives_bounds() {
    let mut random = ChaCha8Rng::seed_from_u64(66);
    let special = [
        0.0_f32,
        -0.0,
        1.0,
        -1.0,
        0.5,
        -0.5,
        f32::MIN_POSITIVE,
        2.0,
        -2.0,
    ];
    let inputs: Vec<Input> = (0..400_000)
        .map(|_| {
            let moments = core::array::from_fn(|_| match random.random_range(0..4) {
                0 => special[random.random_range(0..special.len())],
                1 => 10.0_f32.powf(random.random_range(-20.0..0.3)),
                _ => random.random_range(-2.0..=2.0),
            });
            let depth = match random.random_range(0..4) {
                0 => f64::from(moments[0]),
                1 => f64::from(f32::MAX) * random.random_range(-1.0..=1.0),
                _ => random.random_range(-1.0..=1.0),
            };
            let alpha = 10.0_f32.powf(random.random_range(-7.0..-1.0));
            Input::new(moments, depth, alpha)
        })
        .collect();
    for (input, output) in inputs.iter().zip(bounds(&inputs)) {
        let [lower, upper, shading, _] = output;
        assert!(
            0.0 <= lower && lower <= upper && upper <= 1.0 && (0.0..=1.0).contains(&shading),
            "{input:?} gave {output:?}"
        );
    }
    // Channels of a texel of float storage can be any finite number.
    let any = |random: &mut ChaCha8Rng| loop {
        let value = f32::from_bits(random.random());
        if value.is_finite() {
            return value;
        }
    };
    let inputs: Vec<Input> = (0..200_000)
        .map(|_| Input {
            odd: core::array::from_fn(|_| any(&mut random)),
            depth: any(&mut random),
            even: core::array::from_fn(|_| any(&mut random)),
            alpha: 1e-4,
        })
        .collect();
    for (input, output) in inputs.iter().zip(bounds(&inputs)) {
        assert!(
            (0.0..=1.0).contains(&output[3]),
            "{input:?} gave {output:?}"
        );
    }
}
