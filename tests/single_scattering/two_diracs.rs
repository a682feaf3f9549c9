//! Two depths that have three given moments.

use moment_shadows::Profile;
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const SHADER: &str = "
import moment_shadows::maths::two_diracs::{two_diracs_of_moments};

alias BatchInput = vec4f;
alias BatchOutput = vec4f;

fn batch(input: BatchInput) -> BatchOutput {
    let found = two_diracs_of_moments(input.xyz);
    return vec4f(found.depths, found.weights);
}
";

fn run(moments: &[[f32; 4]]) -> Vec<[f32; 4]> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    Batch::new(&gpu, "two_diracs.wgsl", SHADER)
        .unwrap()
        .run(moments)
        .unwrap()
}

fn moments(atoms: &[(f64, f64)]) -> [f32; 4] {
    let of = |power: i32| {
        atoms
            .iter()
            .map(|(z, weight)| weight * z.powi(power))
            .sum::<f64>() as f32
    };
    [of(1), of(2), of(3), 0.0]
}

#[test]
fn clusters_of_every_width_keep_their_moments() {
    let mut random = ChaCha8Rng::seed_from_u64(45);
    let mut inputs = Vec::new();
    for _ in 0..200_000 {
        // From a single surface to the whole range; every fourth with depths clamped to its ends.
        let width = 10.0_f64.powf(random.random_range(-8.0..0.3));
        let middle = random.random_range(-1.0..1.0);
        let count = random.random_range(1..7);
        let clamped = random.random_range(0..4) == 0;
        let mut atoms: Vec<(f64, f64)> = (0..count)
            .map(|_| {
                let z: f64 = middle + width * random.random_range(-1.0..1.0);
                let end = if z < 0.0 { -1.0 } else { 1.0 };
                let z = if clamped && random.random() {
                    end
                } else {
                    z.clamp(-1.0, 1.0)
                };
                (z, random.random_range(0.01..1.0))
            })
            .collect();
        let total: f64 = atoms.iter().map(|(_, weight)| weight).sum();
        atoms.iter_mut().for_each(|(_, weight)| *weight /= total);
        inputs.push(moments(&atoms));
    }
    let mut largest: f64 = 0.0;
    for (input, output) in inputs.iter().zip(run(&inputs)) {
        let [low, high, first, second] = output.map(f64::from);
        assert!(
            low <= high && first >= 0.0 && second >= 0.0,
            "{input:?} gave {output:?}"
        );
        assert!((first + second - 1.0).abs() <= 1e-6, "{output:?}");
        for power in 1..=3 {
            let found = first * low.powi(power) + second * high.powi(power);
            let residual = (found - f64::from(input[power as usize - 1])).abs();
            largest = largest.max(residual);
            assert!(residual <= 1e-6, "{input:?} gave {output:?}: {residual}");
        }
    }
    println!("largest residual {largest:.1e}");
}

#[test]
fn two_surfaces_are_found() {
    let atoms = [(-0.75, 0.25), (0.5, 0.75)];
    let [found] = run(&[moments(&atoms)])[..] else {
        panic!("one result")
    };
    for (found, expected) in found.into_iter().zip([-0.75, 0.5, 0.25, 0.75]) {
        assert!((found - expected).abs() < 1e-5, "{found} for {expected}");
    }
}

#[test]
fn impossible_moments_give_numbers_all_the_same() {
    let mut random = ChaCha8Rng::seed_from_u64(46);
    let ends = [-1e30, -1.0, 0.0, 1.0, 1e30, 1e-30];
    let mut inputs: Vec<[f32; 4]> = (0..10_000)
        .map(|_| [0; 4].map(|_| random.random_range(-2.0..2.0)))
        .collect();
    for _ in 0..1000 {
        inputs.push([0; 4].map(|_| ends[random.random_range(0..ends.len())]));
    }
    for (input, output) in inputs.iter().zip(run(&inputs)) {
        let [low, high, first, second] = output;
        assert!(
            low.is_finite() && high.is_finite() && low <= high,
            "{input:?} gave {output:?}"
        );
        assert!(
            (0.0..=1.0).contains(&first) && (0.0..=1.0).contains(&second),
            "{input:?} gave {output:?}"
        );
    }
}
