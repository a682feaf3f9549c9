//! Moment depth to stored depth and back.

use moment_shadows::{DepthConversion, DepthRange};
use moment_shadows_lab::batch::Batch;

use crate::brute_force::Convention;
use crate::device;

const SHADER: &str = "
import moment_shadows::map::depth::{DepthConversion, depth_from_moment_depth, depth_of_light, depth_to_moment_depth};

struct BatchInput {
    depth: f32,
    padding: f32,
    numerator: vec2f,
    denominator: vec2f,
    scale: f32,
    offset: f32,
}
alias BatchOutput = vec3f;

fn batch(input: BatchInput) -> BatchOutput {
    let conversion = DepthConversion(input.numerator, input.denominator, input.scale, input.offset, vec2f(0.0));
    let stored = depth_from_moment_depth(input.depth, conversion);
    return vec3f(stored, depth_to_moment_depth(stored, conversion), depth_of_light(conversion));
}
";

type Input = [f32; 8];

fn input(depth: f32, conversion: DepthConversion) -> Input {
    let DepthConversion {
        numerator: n,
        denominator: m,
        scale,
        offset,
        ..
    } = conversion;
    [depth, 0.0, n[0], n[1], m[0], m[1], scale, offset]
}

/// Stored depth, its moment depth, and that of the light. An element of an array of `vec3f` takes 16 bytes.
fn run(inputs: &[Input]) -> Vec<[f32; 4]> {
    let gpu = device::open();
    Batch::<Input, [f32; 4]>::new(&gpu, "depth.wgsl", SHADER)
        .unwrap()
        .run(inputs)
        .unwrap()
}

#[test]
fn stored_depth_is_the_inverse_of_moment_depth() {
    let depths: Vec<f32> = (0..=1000).map(|i| i as f32 / 500.0 - 1.0).collect();
    for convention in Convention::ALL {
        let inputs: Vec<Input> = depths
            .iter()
            .map(|&depth| input(depth, convention.conversion()))
            .collect();
        for (&depth, [stored, again, ..]) in depths.iter().zip(run(&inputs)) {
            let expected = convention.store(f64::from(depth));
            // Coefficients and operations are rounded, four times in all, where stored depth changes fastest: twice as
            // fast as moment depth does.
            assert!(
                (f64::from(stored) - expected).abs() < 5e-7,
                "{convention:?}: {depth} is stored as {stored}, not {expected}"
            );
            // What a step of stored depth near 1 (6e-8) is worth: distances change 16 times as fast at the far end.
            assert!(
                (again - depth).abs() < 4e-6,
                "{convention:?}: {depth} came back as {again}"
            );
            let exact = convention.moment_depth(f64::from(stored));
            assert!(
                (exact - f64::from(depth)).abs() < 4e-6,
                "{convention:?}: {depth} is stored as {exact}"
            );
        }
    }
}

#[test]
fn reversed_depth_keeps_its_precision_far_away() {
    // A ratio of 1e5 between the ends, in reversed float depth with an infinite far plane.
    let range = DepthRange {
        near: 0.01,
        far: 1000.0,
    };
    let conversion = DepthConversion::perspective(0.01, f64::INFINITY, range)
        .unwrap()
        .reversed();
    let depths: Vec<f32> = (0..=1000).map(|i| i as f32 / 500.0 - 1.0).collect();
    let inputs: Vec<Input> = depths
        .iter()
        .map(|&depth| input(depth, conversion))
        .collect();
    for (&depth, [stored, again, ..]) in depths.iter().zip(run(&inputs)) {
        // Three roundings of values up to 2.
        assert!(
            (again - depth).abs() < 4e-7,
            "{depth} is stored as {stored} and came back as {again}"
        );
    }
}

#[test]
fn the_light_lies_where_its_distance_is_zero() {
    for convention in Convention::ALL {
        let found = run(&[input(0.0, convention.conversion())])[0][2];
        match convention {
            // 5 scene units in front of the middle of a range of 8.
            Convention::Perspective { .. } => {
                assert!((found + 1.25).abs() < 1e-6, "{convention:?}: {found}")
            }
            _ => assert_eq!(found, -1e30, "{convention:?}"),
        }
    }
}

#[test]
fn no_moment_depth_and_no_conversion_gives_a_nan() {
    // A range that begins behind the light, and a conversion that only a zeroed buffer holds.
    let behind = DepthRange {
        near: -3.0,
        far: 20.0,
    };
    let mut conversions: Vec<DepthConversion> =
        Convention::ALL.map(Convention::conversion).to_vec();
    conversions.push(DepthConversion::perspective(1.0, 10.0, behind).unwrap());
    conversions.push(
        DepthConversion::perspective(1.0, 10.0, behind)
            .unwrap()
            .reversed(),
    );
    conversions.push(bytemuck::Zeroable::zeroed());
    let hostile = [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::MAX,
        -1.0,
        1.0,
        1e-40,
        -7.0,
    ];
    let mut inputs = Vec::new();
    for &conversion in &conversions {
        inputs.extend(hostile.map(|depth| input(depth, conversion)));
    }
    let found = run(&inputs);
    for (input, output) in inputs.iter().zip(&found) {
        assert!(
            output[..3].iter().all(|value| value.is_finite()),
            "{input:?}: {output:?}"
        );
    }
    // NaN is the far end; what lies outside is stored as the plane that it lies beyond.
    let at = |conversion: usize, depth: usize| found[conversion * hostile.len() + depth][0];
    let ends = [[1.0, 0.0], [0.0, 1.0]];
    for (conversion, [far, near]) in [(7, ends[0]), (8, ends[1])] {
        assert_eq!(at(conversion, 0), far, "NaN");
        assert_eq!(at(conversion, 1), far, "infinity");
        assert_eq!(at(conversion, 2), near, "minus infinity");
        assert_eq!(at(conversion, 4), near, "behind the light");
    }
}
