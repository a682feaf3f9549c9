//! Texels of four moments in 32 bits: what they keep, that whatever they hold is a distribution, and how smooth shadows are.

use bytemuck::{Pod, Zeroable};
use moment_shadows::{Profile, Storage};
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::HALF_ULP;
use super::packed::moments;

#[repr(C)]
#[derive(Clone, Copy, Debug, Default, Pod, Zeroable)]
struct Input {
    moments: [[f32; 4]; 4],
    texels: [u32; 4],
    place: [f32; 2],
    fragment_depth: f32,
    compared: u32,
    as_given: u32,
    padding: [u32; 3],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Output {
    first: [f32; 4],
    average: [f32; 4],
    mean: [f32; 4],
    intensity: f32,
    compared: f32,
    texel: u32,
    padding: u32,
}

fn run(inputs: &[Input]) -> Vec<Output> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    Batch::new(&gpu, "coarse.wgsl", include_str!("coarse.wgsl"))
        .unwrap()
        .run(inputs)
        .unwrap()
}

/// What a texel holds, in f64: two depths, the weight of the second and the pivot.
#[derive(Clone, Copy, Debug)]
struct Held {
    lower: f64,
    upper: f64,
    weight: f64,
    pivot: f64,
}

impl Held {
    fn of(texel: u32) -> Self {
        let bits = |first: u32, count: u32| f64::from((texel >> first) & ((1 << count) - 1));
        let upper = 2.0 * bits(0, 12) / 4095.0 - 1.0;
        let distance = 2.0 * (bits(12, 8) / 255.0).powi(2);
        let u = (bits(20, 7) + 0.5) / 128.0;
        // The last number stands for all that is beyond.
        let share = Some(bits(27, 5)).filter(|&share| share < 31.0);
        let root = (share.unwrap_or(62.0) / 31.0).powi(2) * distance * distance;
        Self {
            lower: (upper - distance).max(-1.0),
            upper,
            weight: u * u * (3.0 - 2.0 * u),
            pivot: (root * root).min(1.0),
        }
    }

    fn moments(self) -> [f64; 4] {
        let atoms = [[self.lower, 1.0 - self.weight], [self.upper, self.weight]];
        let mut all = moments(&atoms);
        all[3] += self.pivot;
        all
    }
}

/// Two surfaces without any spread, at least 0.1 apart.
fn two_surfaces(random: &mut ChaCha8Rng) -> [[f64; 2]; 2] {
    let gap = 10_f64.powf(random.random_range(-1.0..=0.25));
    let near = random.random_range(-1.0..=(1.0 - gap));
    let weight = random.random_range(0.0..=1.0);
    [[near, 1.0 - weight], [near + gap, weight]]
}

fn stored(atoms: &[[f64; 2]]) -> [f32; 4] {
    moments(atoms).map(|moment| moment as f32)
}

#[test]
fn surfaces_move_away_from_the_light_and_not_far() {
    let mut random = ChaCha8Rng::seed_from_u64(8);
    let all: Vec<_> = (0..60_000).map(|_| two_surfaces(&mut random)).collect();
    let inputs: Vec<Input> = all
        .iter()
        .map(|atoms| Input {
            moments: [stored(atoms); 4],
            ..Input::default()
        })
        .collect();
    let mut largest = [0.0_f64; 4];
    for (output, [near, far]) in run(&inputs).iter().zip(&all) {
        let held = Held::of(output.texel);
        for (found, expected) in output.first.into_iter().zip(held.moments()) {
            assert!((f64::from(found) - expected).abs() < 16.0 * HALF_ULP);
        }
        // Of a surface that is hardly there moments in f32 hardly say where it is.
        if !(0.1..=0.9).contains(&far[1]) {
            continue;
        }
        // Skewness is a third central moment with the noise of f32 over the variance.
        let noise = 2.0 * HALF_ULP / (near[1] * far[1] * (far[0] - near[0]).powi(2)) + 1e-5;
        let (lower, upper) = (held.lower - near[0], held.upper - far[0]);
        assert!(
            lower >= -noise && upper >= -noise,
            "{held:?} {near:?} {far:?}"
        );
        largest[0] = largest[0].max((held.weight - far[1]).abs());
        largest[1] = largest[1].max(upper - noise);
        // A step of the distance d is 2 sqrt(2 d) / 255 and a bit.
        let step = 2.0 * (2.0 * (far[0] - near[0] + 1e-3)).sqrt() / 255.0;
        largest[2] = largest[2].max((lower - noise) / (step + 2e-4));
        largest[3] = largest[3].max(held.pivot.sqrt());
    }
    println!("weight, upper depth, lower depth in its steps, root of the pivot: {largest:?}");
    // Half of 128 steps, which are 3 / 2 times as wide in the middle.
    assert!(largest[0] <= 1.5 / 256.0 + 1e-3, "{largest:?}");
    assert!(largest[1] <= 2.0 / 4095.0, "{largest:?}");
    assert!(largest[2] <= 1.0, "{largest:?}");
    // What f32 leaves of 0 is rounded up, at most to the first of 31^2 parts of 2^2.
    assert!(largest[3] <= 4.0 / 961.0, "{largest:?}");
}

/// By what the fourth moment exceeds that of two surfaces is the square of a root. That over their distance is the spread of a surface, which
/// is rounded up, by less than a step.
#[test]
fn surfaces_spread_no_less_and_little_more() {
    let mut random = ChaCha8Rng::seed_from_u64(9);
    let all: Vec<_> = (0..20_000)
        .map(|_| {
            let gap: f64 = random.random_range(0.3..=0.9);
            let near = random.random_range(-1.0..=(1.0 - gap));
            let far_weight = random.random_range(0.1..=0.9);
            let atoms = [[near, 1.0 - far_weight], [near + gap, far_weight]];
            // The root as a share of the squared distance. One beyond 30^2 of 31^2 parts has the last number, which is read as more.
            let share: f64 = random.random_range(0.1..=0.85);
            (atoms, gap, share * gap * gap)
        })
        .collect();
    let inputs: Vec<Input> = all
        .iter()
        .map(|(atoms, _, root)| {
            let [b1, b2, b3, b4] = moments(atoms);
            let exact = [b1, b2, b3, b4 + root * root];
            Input {
                moments: [exact.map(|moment| moment as f32); 4],
                ..Input::default()
            }
        })
        .collect();
    let mut off = [f64::MAX, f64::MIN];
    for (output, (_, gap, root)) in run(&inputs).iter().zip(&all) {
        let held = Held::of(output.texel);
        let distance = held.upper - held.lower;
        // Steps are squares: 31^2 where the spread is as long as the distance.
        let step = |spread: f64| 31.0 * (spread / distance).sqrt();
        let more = step(held.pivot.sqrt() / distance) - step(root / gap);
        off = [off[0].min(more), off[1].max(more)];
    }
    println!("steps more: {off:?}");
    assert!(off[0] >= -0.01 && off[1] <= 1.01, "{off:?}");
}

/// Whatever integers texels hold, a mean of four has positive pivots with the bias, and without it some have not.
#[test]
fn any_integers_give_valid_moments_and_intensities() {
    let mut random = ChaCha8Rng::seed_from_u64(6);
    let bias = Storage::Packed32.moment_bias();
    let inputs: Vec<Input> = (0..200_000)
        .map(|number| {
            let first: u32 = random.random();
            // Texels of one surface are alike, and pivots smallest there.
            let alike = number % 2 == 0;
            let texels = core::array::from_fn(|index| match alike {
                true => {
                    (first & 0x07f0_0fff)
                        ^ ((random.random::<u32>() & 0x0000_3003) * u32::from(index > 0))
                }
                false => random.random(),
            });
            Input {
                texels,
                place: [random.random(), random.random()],
                fragment_depth: random.random_range(-1.2..=1.2),
                as_given: 1,
                ..Input::default()
            }
        })
        .collect();
    let outputs = run(&inputs);
    let apart = outputs.iter().zip(&inputs).flat_map(|(output, input)| {
        // Pivots that no distribution has are cut off after they are summed.
        let is_possible = |texel: &u32| Held::of(*texel).pivot < 1.0;
        let count = 3 + usize::from(input.texels.iter().all(is_possible));
        let pairs = output.mean.into_iter().zip(output.average).take(count);
        pairs.map(|(mean, average)| f64::from(mean - average).abs())
    });
    let apart = apart.fold(0.0, f64::max);
    println!("the mean of a gather is within {apart:.1e} of the average");
    assert!(apart <= 16.0 * HALF_ULP, "{apart:e}");
    let failures = |alpha: f64| {
        let [second, fourth] = [bias.second, bias.fourth].map(f64::from);
        let impossible = |output: &&Output| {
            let b = output.mean.map(f64::from);
            let [b1, b3] = [b[0], b[2]].map(|moment| moment - alpha * moment);
            let b2 = b[1] + alpha * (second - b[1]);
            let b4 = b[3] + alpha * (fourth - b[3]);
            let variance = b2 - b1 * b1;
            let covariance = b3 - b1 * b2;
            variance <= 0.0 || b4 - b2 * b2 - covariance * covariance / variance <= 0.0
        };
        outputs.iter().filter(impossible).count()
    };
    let of = |share: f64| failures(share * f64::from(bias.alpha));
    let (with, third, without) = (of(1.0), of(1.0 / 3.0), of(0.0));
    println!(
        "impossible moments of {}: {with} with the bias, {third} with a third, {without} without",
        outputs.len()
    );
    assert_eq!(with, 0);
    assert!(without > 0);
    let valid = |output: &Output| (0.0..=1.0).contains(&output.intensity);
    assert!(outputs.iter().all(valid));
}

/// The weights of a 9x9 Gaussian of deviation 2.4 along an axis.
fn gaussian() -> [f64; 9] {
    let raw: [f64; 9] =
        core::array::from_fn(|tap| (-0.5 * ((tap as f64 - 4.0) / 2.4).powi(2)).exp());
    raw.map(|weight| weight / raw.iter().sum::<f64>())
}

/// The penumbra of an edge that runs obliquely through the texels, at four pixels per texel along either axis, between surfaces `gap` apart:
/// the largest difference of intensity from that of float32, and by how much that grows from one pixel to the next.
fn penumbrae(gaps: core::ops::RangeInclusive<f64>) -> [f64; 2] {
    const SIDE: usize = 16;
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let kernel = gaussian();
    let mut inputs = Vec::new();
    for _ in 0..24 {
        let gap = 10_f64.powf(random.random_range(gaps.clone()));
        let far = random.random_range((gap - 0.95)..=0.95);
        let (sine, cosine) = random.random_range(0.0..core::f64::consts::TAU).sin_cos();
        let is_near = |x: f64, y: f64| (x - 7.7) * cosine + (y - 7.3) * sine > 0.0;
        let texel = |x: usize, y: usize| {
            let mut near = 0.0;
            for (dy, row) in kernel.iter().enumerate() {
                for (dx, column) in kernel.iter().enumerate() {
                    let place = [x + dx, y + dy].map(|it| it as f64 - 4.0);
                    near += row * column * f64::from(u8::from(is_near(place[0], place[1])));
                }
            }
            stored(&[[far - gap, near], [far, 1.0 - near]])
        };
        let texels: Vec<Vec<[f32; 4]>> = (0..SIDE)
            .map(|y| (0..SIDE).map(|x| texel(x, y)).collect())
            .collect();
        for y in 0..4 * (SIDE - 1) {
            for x in 0..4 * (SIDE - 1) {
                let ([x0, y0], place) = ([x / 4, y / 4], [x % 4, y % 4].map(|it| it as f32 / 4.0));
                let at = |dx: usize, dy: usize| texels[y0 + dy][x0 + dx];
                inputs.push(Input {
                    moments: [at(0, 0), at(1, 0), at(0, 1), at(1, 1)],
                    place,
                    // The receiver, with the constant bias of a surface that faces the light.
                    fragment_depth: (far - 3e-5) as f32,
                    compared: Storage::Float32.wgsl_index(),
                    ..Input::default()
                });
            }
        }
    }
    let side = 4 * (SIDE - 1);
    let mut largest = [0.0_f64; 2];
    for picture in run(&inputs).chunks(side * side) {
        let off: Vec<f64> = picture
            .iter()
            .map(|it| f64::from(it.intensity - it.compared))
            .collect();
        for (index, one) in off.iter().enumerate() {
            largest[0] = largest[0].max(one.abs());
            let next = [
                (index % side + 1 < side).then_some(1),
                (index + side < off.len()).then_some(side),
            ];
            for further in next.into_iter().flatten() {
                largest[1] = largest[1].max((off[index + further] - one).abs());
            }
        }
    }
    largest.map(|it| 255.0 * it)
}

/// At four pixels per texel, so that texels show.
#[test]
fn penumbrae_are_as_smooth_as_those_of_float32() {
    let [far, step] = penumbrae(-0.5..=0.0);
    println!("surfaces 0.3 to 1 apart: {far:.2}/255, {step:.2}/255 from pixel to pixel");
    assert!(far <= 2.0, "{far}");
    assert!(step <= 1.0, "{step}");
    let [near, step] = penumbrae(-1.5..=-0.5);
    println!("0.03 to 0.3 apart: {near:.2}/255, {step:.2}/255 from pixel to pixel");
    assert!(near <= 6.0, "{near}");
    assert!(step <= 3.0, "{step}");
}

/// A surface is lit by its own depth: it casts no shadow on itself half a step in front of it, and a full one well behind.
#[test]
fn a_surface_is_lit_in_front_and_shadowed_behind() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let (in_front, behind) = (3e-5, 0.012);
    let mut inputs = Vec::new();
    for _ in 0..20_000 {
        let depth: f64 = random.random_range(-0.85..=0.85);
        for offset in [-in_front, behind] {
            inputs.push(Input {
                moments: [stored(&[[depth, 1.0]]); 4],
                place: [0.5; 2],
                fragment_depth: (depth + offset) as f32,
                compared: Storage::Float32.wgsl_index(),
                ..Input::default()
            });
        }
    }
    let outputs = run(&inputs);
    let darkest = outputs.iter().step_by(2).map(|it| it.intensity);
    let darkest = darkest.fold(0.0, f32::max);
    let lightest = outputs.iter().skip(1).step_by(2).map(|it| it.intensity);
    let lightest = lightest.fold(1.0, f32::min);
    println!("at most {darkest:.5} in front, at least {lightest:.4} behind");
    assert!(darkest <= 1e-4, "{darkest}");
    assert!(lightest >= 0.98, "{lightest}");
}
