//! The blockers that moments tell of, against the canonical distribution in exact arithmetic.

use core::cmp::Ordering;

use bytemuck::{Pod, Zeroable};
use moment_shadows::Profile;
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use moment_shadows_lab::oracle::{hamburger, rational, sensitivity, tolerance_unit};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Input {
    biased: [f32; 4],
    depth: f32,
    alpha: f32,
    smallest_variance: f32,
    padding: f32,
}

/// Share and mean depth of the blockers.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Output {
    four: [f32; 2],
    two: [f32; 2],
}

fn run(inputs: &[Input]) -> Vec<Output> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    Batch::new(&gpu, "blockers.wgsl", include_str!("blockers.wgsl"))
        .unwrap()
        .run(inputs)
        .unwrap()
}

/// A bias of a table of unorm16.
const ALPHA: f32 = 3.8e-5;

/// Moments of surfaces, biased.
fn input(atoms: &[(f64, f64)], depth: f32) -> Input {
    let target = [0.0, 0.628, 0.0, 0.628];
    let moment = |power: i32| -> f64 { atoms.iter().map(|(z, w)| w * z.powi(power)).sum() };
    let biased = [1, 2, 3, 4].map(|power| {
        let moment = moment(power);
        (moment + f64::from(ALPHA) * (target[power as usize - 1] - moment)) as f32
    });
    Input {
        biased,
        depth,
        alpha: ALPHA,
        smallest_variance: 6e-5,
        padding: 0.0,
    }
}

/// Share and mean of what the canonical distribution of the very moments has in front of the fragment, and the unit in which
/// a share's error is counted.
fn canonical(moments: &[f32], depth: f32) -> ([f64; 2], f64) {
    let exact = |value: &f32| rational(f64::from(*value)).unwrap();
    let moments: Vec<_> = moments.iter().map(exact).collect();
    let extremal = hamburger(&moments, &exact(&depth)).unwrap();
    let unit = tolerance_unit(sensitivity(&moments, &exact(&depth), &extremal).unwrap()[0]);
    let in_front = extremal
        .points
        .iter()
        .filter(|point| point.side == Ordering::Less);
    let (share, sum) = in_front.fold((0.0, 0.0), |(share, sum), point| {
        let weight = point.weight.to_f64().value();
        (
            share + weight,
            sum + weight * point.position.to_f64().value(),
        )
    });
    // As published: mixed with a share of 1e-3 at the fragment, and within the light's range.
    let mean = (sum + 1e-3 * f64::from(depth)) / (share + 1e-3);
    ([share, mean.clamp(-1.0, 1.0)], unit)
}

fn random_inputs(count: usize) -> Vec<Input> {
    let mut random = ChaCha8Rng::seed_from_u64(57);
    (0..count)
        .map(|_| {
            let surfaces = random.random_range(1..=4);
            let mut atoms: Vec<(f64, f64)> = (0..surfaces)
                .map(|_| {
                    (
                        random.random_range(-1.0..1.0),
                        random.random_range(0.05..1.0),
                    )
                })
                .collect();
            let total: f64 = atoms.iter().map(|(_, weight)| weight).sum();
            atoms.iter_mut().for_each(|(_, weight)| *weight /= total);
            // Next to a surface or anywhere.
            let depth = if random.random_bool(0.3) {
                atoms[0].0 + random.random_range(-0.1..0.1)
            } else {
                random.random_range(-1.0..1.0)
            };
            input(&atoms, depth.clamp(-1.0, 1.0) as f32)
        })
        .collect()
}

/// The largest error of shares in their unit, and of mean depths.
fn largest_errors(cases: impl Iterator<Item = ([f32; 2], [f64; 2], f64)>) -> [f64; 2] {
    cases.fold([0.0, 0.0], |[share, depth], (found, truth, unit)| {
        let error = |part: usize| (f64::from(found[part]) - truth[part]).abs();
        [share.max(error(0) / unit), depth.max(error(1))]
    })
}

#[test]
fn four_moments_give_the_points_in_front_of_their_canonical_distribution() {
    let inputs = random_inputs(4000);
    let cases = inputs.iter().zip(run(&inputs)).map(|(input, found)| {
        let (truth, unit) = canonical(&input.biased, input.depth);
        (found.four, truth, unit)
    });
    let [share, depth] = largest_errors(cases);
    println!("share off by {share:.1} units, mean depth by {depth:.1e}");
    // As for the bounds themselves.
    assert!(share <= 8.0);
    // A share's error of up to 1e-4, times a distance of up to 2, over a share of 1e-3 and more: seldom so much at once.
    assert!(depth <= 1e-2);
}

#[test]
fn two_moments_give_the_other_point() {
    let inputs = random_inputs(4000);
    let found = run(&inputs);
    let cases = inputs
        .iter()
        .zip(found)
        .filter(|(input, _)| {
            let [b1, b2] = [input.biased[0], input.biased[1]].map(f64::from);
            b2 - b1 * b1 > f64::from(input.smallest_variance)
        })
        .map(|(input, found)| {
            let (truth, unit) = canonical(&input.biased[..2], input.depth);
            (found.two, truth, unit)
        });
    let [share, depth] = largest_errors(cases);
    println!("share off by {share:.1} units, mean depth by {depth:.1e}");
    assert!(share <= 8.0);
    assert!(depth <= 1e-3);
}

#[test]
fn a_receiver_behind_one_blocker_sees_its_depth() {
    let cases: Vec<(f64, f64, f64)> = vec![
        (-0.5, 0.5, 0.3),
        (0.1, 0.9, 0.02),
        (-0.9, -0.7, 0.6),
        (-1.0, 1.0, 0.9),
    ];
    let inputs: Vec<Input> = cases
        .iter()
        .map(|&(blocker, receiver, share)| {
            input(
                &[(blocker, share), (receiver, 1.0 - share)],
                receiver as f32,
            )
        })
        .collect();
    for (&(blocker, receiver, share), found) in cases.iter().zip(run(&inputs)) {
        let [found_share, found_depth] = found.four.map(f64::from);
        assert!(
            (found_share - share).abs() <= 1e-2,
            "{found_share} of {share}"
        );
        // Exact but for the bias, and for a share of 1e-3 that is put at the receiver.
        let tolerance = (receiver - blocker) * (1e-3 / share + 2e-2);
        assert!(
            (found_depth - blocker).abs() <= tolerance,
            "{found_depth} of {blocker}"
        );
    }
}

#[test]
fn nothing_in_front_leaves_the_receiver_alone() {
    let inputs: Vec<Input> = [-1.0, -0.3, 0.4, 0.99]
        .into_iter()
        .map(|depth| input(&[(depth, 0.4), (1.0, 0.6)], depth as f32))
        .collect();
    for (input, found) in inputs.iter().zip(run(&inputs)) {
        for [share, depth] in [found.four, found.two] {
            assert!(share <= 1e-3, "{input:?}: {share}");
            // At most half of the way of a blocker at the near end, by a share that is at most 1e-4.
            assert!((depth - input.depth).abs() <= 0.05, "{input:?}: {depth}");
        }
    }
}

/// Whatever the moments: both results are numbers in their ranges.
#[test]
fn invalid_moments_give_numbers_in_range() {
    let mut random = ChaCha8Rng::seed_from_u64(58);
    let inputs: Vec<Input> = (0..100_000)
        .map(|_| Input {
            biased: core::array::from_fn(|_| random.random_range(-2.1..2.1)),
            depth: match random.random_range(0..4) {
                0 => 1e30,
                1 => -1e30,
                _ => random.random_range(-1.5..1.5),
            },
            alpha: 1e-7,
            smallest_variance: 1e-7,
            padding: 0.0,
        })
        .collect();
    for (input, found) in inputs.iter().zip(run(&inputs)) {
        for [share, depth] in [found.four, found.two] {
            assert!(
                (0.0..=1.0).contains(&share) && (-1.0..=1.0).contains(&depth),
                "{input:?}: {found:?}"
            );
        }
    }
}
