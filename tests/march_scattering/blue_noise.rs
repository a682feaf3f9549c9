//! The tile of blue noise, made anew by void and cluster (Ulichney, SPIE 1993).

use std::collections::BTreeSet;

use moment_shadows::Profile;
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;

/// Pixels per side.
const SIDE: usize = 16;
const COUNT: usize = SIDE * SIDE;

/// Deviation in pixels of the Gaussian by which pixels crowd each other.
const DEVIATION: f64 = 1.5;

/// Energies that differ by less are equal: of those the first pixel counts.
const EQUAL: f64 = 1e-9;

type Pixels = BTreeSet<usize>;

/// How crowded a pixel is.
fn energy(pixels: &Pixels, at: usize) -> f64 {
    let apart = |a: usize, b: usize| {
        let distance = a.abs_diff(b);
        distance.min(SIDE - distance) as f64
    };
    let of = |other: &usize| {
        let (x, y) = (
            apart(at % SIDE, other % SIDE),
            apart(at / SIDE, other / SIDE),
        );
        (-(x * x + y * y) / (2.0 * DEVIATION * DEVIATION)).exp()
    };
    pixels.iter().map(of).sum()
}

/// The most crowded of the pixels.
fn cluster(pixels: &Pixels) -> usize {
    let mut found = (usize::MAX, f64::NEG_INFINITY);
    for &pixel in pixels {
        let energy = energy(pixels, pixel);
        if energy > found.1 + EQUAL {
            found = (pixel, energy);
        }
    }
    found.0
}

/// The least crowded of all others.
fn void(pixels: &Pixels) -> usize {
    let mut found = (usize::MAX, f64::INFINITY);
    for pixel in (0..COUNT).filter(|pixel| !pixels.contains(pixel)) {
        let energy = energy(pixels, pixel);
        if energy < found.1 - EQUAL {
            found = (pixel, energy);
        }
    }
    found.0
}

fn ranks() -> Vec<usize> {
    // A tenth of the pixels, anywhere, and then spread.
    let (mut first, mut state) = (Pixels::new(), 1_u64);
    while first.len() < COUNT / 10 {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        first.insert((state >> 33) as usize % COUNT);
    }
    loop {
        let crowded = cluster(&first);
        first.remove(&crowded);
        let free = void(&first);
        first.insert(free);
        if free == crowded {
            break;
        }
    }
    let mut ranks = vec![0; COUNT];
    let mut left = first.clone();
    for rank in (0..first.len()).rev() {
        let crowded = cluster(&left);
        ranks[crowded] = rank;
        left.remove(&crowded);
    }
    for rank in first.len()..COUNT {
        let free = void(&first);
        ranks[free] = rank;
        first.insert(free);
    }
    ranks
}

/// Place and turn; the offset.
fn offsets(turn: f32) -> Vec<f32> {
    const SHADER: &str = "
import moment_shadows::maths::blue_noise::{blue_noise_offset};
alias BatchInput = vec4f;
alias BatchOutput = f32;
fn batch(input: vec4f) -> f32 {
    return blue_noise_offset(vec2u(input.xy), input.z);
}
";
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    // Of the second tile in both directions, too.
    let place = |pixel: usize| {
        [
            (pixel % SIDE + SIDE) as f32,
            (pixel / SIDE) as f32,
            turn,
            0.0,
        ]
    };
    let inputs: Vec<[f32; 4]> = (0..COUNT).map(place).collect();
    let batch = Batch::new(&gpu, "blue_noise.wgsl", SHADER).unwrap();
    batch.run(&inputs).unwrap()
}

#[test]
fn the_tile_is_what_void_and_cluster_makes() {
    let ranks = ranks();
    let found: Vec<usize> = offsets(0.0)
        .iter()
        .map(|offset| (offset * COUNT as f32 - 0.5) as usize)
        .collect();
    assert_eq!(found, ranks);
}

#[test]
fn its_error_is_of_high_frequency() {
    let offsets = offsets(0.0);
    // The power of a frequency, as a part of what white noise has of each.
    let power = |u: usize, v: usize| {
        let [mut real, mut imaginary] = [0.0; 2];
        for (pixel, &offset) in offsets.iter().enumerate() {
            let turn = (u * (pixel % SIDE) + v * (pixel / SIDE)) as f64 / SIDE as f64;
            let (sine, cosine) = (core::f64::consts::TAU * turn).sin_cos();
            real += (f64::from(offset) - 0.5) * cosine;
            imaginary += (f64::from(offset) - 0.5) * sine;
        }
        (real * real + imaginary * imaginary) / (COUNT as f64 / 12.0)
    };
    let (mut low, mut high) = (Vec::new(), Vec::new());
    for u in 0..SIDE {
        for v in 0..SIDE {
            let [x, y] = [u, v].map(|it| it.min(SIDE - it) as f64);
            match x.hypot(y) {
                0.0 => {}
                radius if radius < 4.0 => low.push(power(u, v)),
                radius if radius > 6.5 => high.push(power(u, v)),
                _ => {}
            }
        }
    }
    let mean = |all: &[f64]| all.iter().sum::<f64>() / all.len() as f64;
    let (low, high) = (mean(&low), mean(&high));
    println!("low {low}, high {high}");
    assert!(low < 0.2 && high > 1.2, "{low} {high}");
}

#[test]
fn offsets_turn_and_stay_below_one() {
    for turn in [0.0, 0.618_034, 0.999_999_9] {
        let found = offsets(turn);
        assert!(found.iter().all(|it| (0.0..1.0).contains(it)), "{turn}");
        let distinct: BTreeSet<u32> = found.iter().map(|it| it.to_bits()).collect();
        assert_eq!(distinct.len(), COUNT);
    }
}
