//! What drivers do that WGSL allows, and no module depends on: each function on harmless input on which a built-in function fails
//! somewhere. They assert what the modules give, on any driver.

use bytemuck::{Pod, Zeroable};
use half::f16;
use moment_shadows::Profile;
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::HALF_ULP;

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Input {
    function: u32,
    again: f32,
    given: [f32; 2],
}

/// What a function of `drivers.wgsl` gives for pairs of numbers.
fn run(function: u32, given: &[[f32; 2]]) -> Vec<[f32; 2]> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let inputs: Vec<Input> = given
        .iter()
        .map(|&given| Input {
            function,
            again: given[0],
            given,
        })
        .collect();
    Batch::new(&gpu, "drivers.wgsl", include_str!("drivers.wgsl"))
        .unwrap()
        .run(&inputs)
        .unwrap()
}

/// SwiftShader's `atan2` is half a turn off for y = -0.
#[test]
fn arc_tangents_take_a_negative_zero_for_zero() {
    let found = run(0, &[[1.0, -0.0], [-1.0, -0.0], [1.0, 0.0], [-1.0, 0.0]]);
    let pi = core::f32::consts::PI;
    for ([found, _], expected) in found.into_iter().zip([0.0, pi, 0.0, pi]) {
        assert!((found - expected).abs() <= 3e-7, "{found} for {expected}");
    }
}

/// WGSL lets `mix(a, a, t)` be other than a, and above 1 between numbers of 1.
#[test]
fn between_equal_texels_and_between_equal_bounds_there_is_nothing_else() {
    let mut random = ChaCha8Rng::seed_from_u64(9);
    let mut given: Vec<[f32; 2]> = (0..20_000)
        .map(|_| [random.random_range(0.0..=1.0), random.random()])
        .collect();
    given.extend((0..1000).map(|_| [1.0, random.random()]));
    for ([value, share], found) in given.iter().zip(run(1, &given)) {
        assert_eq!(found, [*value; 2], "at {share}");
    }
}

/// SwiftShader's `mix(a, b, 1)` is 0 for b = 1 and a large a.
#[test]
fn a_contact_shadow_fades_by_its_end_however_far_the_other_one_is() {
    // A quarter of the length is where it fades: at 0.8 of it four fifths are left. Where it begins nothing has faded.
    let given = [[1.0, 0.8], [1e3, 0.8], [1e9, 0.8], [1e12, 0.8]];
    for (given, [end, start]) in given.iter().zip(run(2, &given)) {
        assert!(
            (end - 0.8).abs() <= 8.0 * HALF_ULP as f32,
            "{given:?}: {end}"
        );
        assert_eq!(start, 1.0, "{given:?}");
    }
}

/// SwiftShader's `quantizeToF16` truncates, and is infinite above 65504.
#[test]
fn halves_are_the_nearest_ones_up_to_the_largest() {
    let mut random = ChaCha8Rng::seed_from_u64(10);
    let mut given: Vec<[f32; 2]> = (0..20_000)
        .map(|_| {
            let magnitude = 2.0_f32.powf(random.random_range(-26.0..15.99));
            [magnitude, -magnitude]
        })
        .collect();
    given.extend([
        [65504.0, -65504.0],
        [65503.0, 65488.0],
        [1.0 + 0.75 / 1024.0, 0.0],
    ]);
    // Ties to even.
    given.push([1.0 + 0.5 / 1024.0, 1.0 + 1.5 / 1024.0]);
    for (given, found) in given.iter().zip(run(3, &given)) {
        assert_eq!(
            found,
            given.map(|value| f16::from_f32(value).to_f32()),
            "{given:?}"
        );
    }
}

/// Subnormal numbers may be flushed to zero or not.
#[test]
fn subnormal_numbers_are_as_good_as_zero() {
    let tiny = 1e-40;
    // Angles of vectors that are too short for one, and of one that is not.
    let found = run(0, &[[tiny, tiny], [-tiny, 0.0], [1e-37, 1e-37]]);
    let quarter = core::f32::consts::FRAC_PI_4;
    for ([found, _], expected) in found.into_iter().zip([0.0, 0.0, quarter]) {
        assert!((found - expected).abs() <= 1e-7, "{found} for {expected}");
    }
    // A surface there, and fragments on it and well behind.
    let given = [tiny, -tiny, 0.0].map(|depth| [[depth, depth], [depth, 0.5]]);
    for found in run(4, &given.concat()).chunks(2) {
        assert!(found[0][0] <= 1.5e-6 && found[1][0] >= 0.9999, "{found:?}");
    }
}

/// A driver may add up the factors of a chain of `fma` with constants first, and so lose what the lowest of them is there for;
/// SwiftShader's `sin` is coarser than that.
#[test]
fn sines_of_many_turns_have_all_parts_of_pi() {
    let given: Vec<[f32; 2]> = (0..=6000)
        .map(|quarters| {
            [
                (f64::from(quarters) * core::f64::consts::FRAC_PI_2) as f32,
                0.0,
            ]
        })
        .collect();
    for ([angle, _], [sine, cosine]) in given.iter().zip(run(5, &given)) {
        let (exact_sine, exact_cosine) = f64::from(*angle).sin_cos();
        for (found, exact) in [(sine, exact_sine), (cosine, exact_cosine)] {
            let error = (f64::from(found) - exact).abs();
            // Without the third part it would be 4e-8 per quarter.
            assert!(error <= 4.0 * HALF_ULP, "{angle}: {found} for {exact}");
        }
    }
}
