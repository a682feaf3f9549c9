//! The lower bound of four moments, in f64.

use glam::DVec3;
use moment_shadows_lab::truth::exact_bound::{exact_bound, lower_bound, lower_bound_of_moments};
use moment_shadows_lab::truth::lookup::Lookup;
use moment_shadows_lab::truth::pcf::pcf;
use moment_shadows_lab::truth::surface::DepthRounding;

use crate::setup::{Random, depth_map, gaussian, parallel_light, surface};

#[test]
fn the_exact_bound_reproduces_one_and_two_depths() {
    // A fragment at a depth is not behind it.
    for (fragment, expected) in [(-0.9, 0.0), (0.25, 0.0), (0.250_000_1, 1.0), (0.9, 1.0)] {
        assert_eq!(
            lower_bound(&[0.25; 3], &[0.5, 0.25, 0.25], fragment),
            expected
        );
    }
    let mut random = Random(3);
    for gap in [1.0, 1e-2, 1e-4, 1e-6] {
        for _ in 0..200 {
            let front = random.between(-1.0, 0.0);
            let weight = random.between(1e-3, 0.999);
            let depths = [front, front + gap, front];
            let weights = [0.3 * weight, 1.0 - weight, 0.7 * weight];
            for (fragment, expected) in [
                (front - 0.1, 0.0),
                (front, 0.0),
                (front + 0.1 * gap, weight),
                (front + 0.9 * gap, weight),
                (front + gap, weight),
                (front + 1.1 * gap, 1.0),
            ] {
                let bound = lower_bound(&depths, &weights, fragment);
                // Depths of size 1 are rounded to 1e-16, of which a gap of 1e-6 leaves 1e-10.
                assert!(
                    (bound - expected).abs() < 1e-8,
                    "gap {gap}, {fragment}: {bound} instead of {expected}"
                );
            }
        }
    }
}

/// The published algorithm (Peters & Klein, i3D 2015, Algorithm 2) with Cramer's rule: a system for the polynomial
/// whose roots are the other two depths, and Lagrange's form for their weights.
fn published(b: [f64; 4], f: f64) -> f64 {
    let m = [1.0, b[0], b[1], b[2], b[3]];
    let det = |r: [[f64; 3]; 3]| {
        r[0][0] * (r[1][1] * r[2][2] - r[1][2] * r[2][1])
            - r[0][1] * (r[1][0] * r[2][2] - r[1][2] * r[2][0])
            + r[0][2] * (r[1][0] * r[2][1] - r[1][1] * r[2][0])
    };
    let right = [1.0, f, f * f];
    let c: [f64; 3] = std::array::from_fn(|column| {
        let matrix = std::array::from_fn(|j| {
            std::array::from_fn(|k| if k == column { right[j] } else { m[j + k] })
        });
        det(matrix)
    });
    let (p, q) = (c[1] / c[2], c[0] / c[2]);
    let root = (0.25 * p * p - q).sqrt();
    let roots = [-0.5 * p - root, -0.5 * p + root];
    let weight =
        |at: f64, other: f64| (b[1] - b[0] * (other + f) + other * f) / ((at - other) * (at - f));
    let in_front = |at: f64, other: f64| if at < f { weight(at, other) } else { 0.0 };
    in_front(roots[0], roots[1]) + in_front(roots[1], roots[0])
}

#[test]
fn the_exact_bound_is_sharp_and_never_darker_than_the_truth() {
    let mut random = Random(4);
    let mut largest = 0.0f64;
    for _ in 0..20_000 {
        let count = 3 + (4.0 * random.next()) as usize;
        let depths: Vec<f64> = (0..count).map(|_| random.between(-1.0, 1.0)).collect();
        let weights: Vec<f64> = (0..count).map(|_| random.between(0.05, 1.0)).collect();
        let total: f64 = weights.iter().sum();
        let weights: Vec<f64> = weights.iter().map(|w| w / total).collect();
        let fragment = random.between(-1.0, 1.0);
        let moments: [f64; 4] = std::array::from_fn(|j| {
            let power = j as i32 + 1;
            depths
                .iter()
                .zip(&weights)
                .map(|(z, w)| w * z.powi(power))
                .sum()
        });
        let bound = lower_bound(&depths, &weights, fragment);
        let truth: f64 = depths
            .iter()
            .zip(&weights)
            .filter(|(z, _)| **z < fragment)
            .map(|(_, w)| w)
            .sum();
        assert!(
            (0.0..=truth + 1e-9).contains(&bound),
            "{bound} above {truth}"
        );
        let of_moments = lower_bound_of_moments(moments, fragment);
        // The published form loses digits where its polynomial degenerates and where two depths are close; of 20,000
        // samples at least 99 in 100 agree to 1e-6.
        let difference = (bound - published(moments, fragment)).abs();
        if difference > 1e-6 || difference.is_nan() {
            largest += 1.0;
        }
        assert!((bound - of_moments).abs() < 1e-4, "{bound}, {of_moments}");
    }
    assert!(largest < 200.0, "{largest} samples differ");
}

#[test]
fn the_exact_bound_is_continuous_at_gauss_nodes() {
    // Three depths alike: p2 = x^3 - .. has its roots at plus and minus sqrt(2/3); there a point of the extremal
    // distribution passes through infinity.
    let (depths, weights) = ([-1.0, 0.0, 1.0], [1.0 / 3.0; 3]);
    let node = (2.0f64 / 3.0).sqrt();
    for (fragment, expected) in [(-node, 0.0), (node, 0.5)] {
        for offset in [0.0, 1e-16, -1e-15, 1e-12, -1e-12, 1e-9, -1e-9] {
            let bound = lower_bound(&depths, &weights, fragment + offset);
            // The slope of the bound there is below 10.
            assert!((bound - expected).abs() < 1e-8, "{offset}: {bound}");
        }
    }
}

#[test]
fn the_exact_bound_of_a_picture_looks_at_the_same_depths() {
    let light = parallel_light();
    let mut random = Random(5);
    // Two depths under each lookup: the bound is the truth for a receiver between them.
    let depths = depth_map(&light, [32, 32], 4, DepthRounding::Float32, |_| {
        if random.next() < 0.4 { 0.5 } else { 1.5 }
    });
    let points: Vec<(DVec3, DVec3)> = (0..500)
        .map(|_| {
            let (x, y) = (random.between(-1.0, 1.0), random.between(-1.0, 1.0));
            (DVec3::new(x, y, -1.1), DVec3::Z)
        })
        .collect();
    let truth = pcf(&light, &depths, &gaussian(), &surface(&points)).unwrap();
    let lookups: Vec<Option<Lookup>> = points
        .iter()
        .map(|&(point, _)| {
            let point = point.as_vec3().as_dvec3();
            Some(Lookup {
                uv: light.uv(point)?.to_array(),
                fragment_depth: light.moment_depth(point),
            })
        })
        .chain([None])
        .collect();
    let bound = exact_bound(&depths, &gaussian(), &lookups);
    assert_eq!(bound.len(), 501);
    assert_eq!(bound[500], 0.0);
    for (bound, truth) in bound.iter().zip(&truth) {
        assert!((bound - truth).abs() < 1e-5, "{bound} instead of {truth}");
    }
}
