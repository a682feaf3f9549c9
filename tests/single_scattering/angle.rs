//! Angles to 4 units in the last place.

use moment_shadows::Profile;
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// What the module promises.
const ULPS: f64 = 4.0;

const SHADER: &str = "
import moment_shadows::maths::angle::{angle_atan2, angle_sin_cos};

alias BatchInput = vec2f;
alias BatchOutput = vec4f;

fn batch(input: BatchInput) -> BatchOutput {
    return vec4f(angle_atan2(input.y, input.x), angle_sin_cos(input.x), 0.0);
}
";

/// atan2(y, x), sin(x) and cos(x) of points (x, y).
fn angles(points: &[[f32; 2]]) -> Vec<[f32; 4]> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    Batch::new(&gpu, "angles.wgsl", SHADER)
        .unwrap()
        .run(points)
        .unwrap()
}

/// The spacing of f32 at a value.
fn ulp(value: f64) -> f64 {
    let exponent = value.abs().max(f64::from(f32::MIN_POSITIVE)).log2().floor();
    (exponent - 23.0).exp2()
}

#[test]
fn arc_tangents_are_within_four_units() {
    let mut random = ChaCha8Rng::seed_from_u64(6);
    let mut points = Vec::new();
    // All around the circle, densely at the axes and diagonals, and every ratio of magnitudes.
    for step in 0..400_000 {
        let angle = f64::from(step) * core::f64::consts::TAU / 400_000.0;
        points.push([angle.cos() as f32, angle.sin() as f32]);
    }
    for _ in 0..400_000 {
        let exponents = [0, 1].map(|_| random.random_range(-36.0..36.0_f64));
        let signs = [0, 1].map(|_| if random.random() { 1.0 } else { -1.0 });
        points.push([0, 1].map(|axis| (signs[axis] * 10.0_f64.powf(exponents[axis])) as f32));
        let near = 1.0 + random.random_range(-1e-3..1e-3_f64);
        points.push([signs[0] as f32, (signs[1] * near) as f32]);
        let edge = 0.414_213_56 * (1.0 + random.random_range(-1e-5..1e-5_f64));
        points.push([(signs[0] * edge) as f32, signs[1] as f32]);
    }
    let mut largest: f64 = 0.0;
    for (point, [found, ..]) in points.iter().zip(angles(&points)) {
        let [x, y] = point.map(f64::from);
        let exact = y.atan2(x);
        // Quotients below the smallest normal number may be flushed to zero.
        if exact.abs() < 1e-37 {
            assert!(f64::from(found).abs() <= 1.2e-37, "{point:?}: {found}");
            continue;
        }
        let error = (f64::from(found) - exact).abs() / ulp(exact);
        largest = largest.max(error);
        assert!(error <= ULPS, "atan2 of {point:?}: {error} ulp");
    }
    println!("atan2: {largest:.2} ulp");
}

#[test]
fn sines_and_cosines_are_within_four_units() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let mut points: Vec<[f32; 2]> = (0..1_000_000)
        .map(|step| [(f64::from(step) * 25.2 / 1e6 - 12.6) as f32, 0.0])
        .collect();
    points.extend((0..200_000).map(|_| [random.random_range(-1e4..1e4), 0.0]));
    let mut largest: f64 = 0.0;
    for (point, [_, sine, cosine, _]) in points.iter().zip(angles(&points)) {
        let angle = f64::from(point[0]);
        for (found, exact) in [(sine, angle.sin()), (cosine, angle.cos())] {
            // Near a zero the angle itself is not known any better than that.
            let unit = ulp(exact).max(angle.abs().min(1.0) * ulp(0.5) * 0.125);
            let error = (f64::from(found) - exact).abs() / unit;
            largest = largest.max(error);
            assert!(
                error <= ULPS,
                "of {angle}: {found}, not {exact}: {error} ulp"
            );
        }
    }
    println!("sine and cosine: {largest:.2} ulp");
}

#[test]
fn degenerate_angles_are_defined() {
    let pi = core::f32::consts::PI;
    // 2^-124: what is less counts as 0.
    let least = 4.0 * f32::MIN_POSITIVE;
    let cases = [
        ([0.0, 0.0], 0.0),
        ([-0.0, -0.0], 0.0),
        ([1.0, 0.0], 0.0),
        ([-1.0, 0.0], pi),
        ([-1.0, -0.0], pi),
        ([0.0, 1.0], 0.5 * pi),
        ([0.0, -1.0], -0.5 * pi),
        ([-1.0, f32::NAN], pi),
        ([f32::NAN, f32::NAN], 0.0),
        ([f32::NAN, -2.0], -0.5 * pi),
        ([f32::INFINITY, 1.0], 0.5 * pi),
        ([f32::MAX, f32::MAX], 0.25 * pi),
        ([1e-45, 1e-45], 0.0),
        ([0.0, least], 0.5 * pi),
        ([0.0, least.next_down()], 0.0),
        ([-f32::MAX, 1e-30], pi),
    ];
    let points = cases.map(|(point, _)| point);
    for ((point, expected), found) in cases.into_iter().zip(angles(&points)) {
        assert!(
            (found[0] - expected).abs() <= 2.0 * f32::EPSILON,
            "{point:?}: {}, not {expected}",
            found[0]
        );
        assert!(
            found.iter().all(|value| value.abs() <= 3.2),
            "{point:?}: {found:?}"
        );
    }
}

#[test]
fn view_rays_have_the_angles_of_their_directions() {
    const SHADER: &str = "
import moment_shadows::air::rectified_frame::{rectified_frame_view_ray};
alias BatchInput = vec4f;
alias BatchOutput = vec4f;
fn batch(input: BatchInput) -> BatchOutput {
    let ray = rectified_frame_view_ray(input.xyz);
    return vec4f(ray.coordinates, ray.length);
}
";
    let mut random = ChaCha8Rng::seed_from_u64(8);
    let mut component = || {
        let exponent = random.random_range(-6.0..1.0_f64);
        let sign = if random.random() { 1.0 } else { -1.0 };
        (sign * 10.0_f64.powf(exponent)) as f32
    };
    let mut directions: Vec<[f32; 4]> = (0..200_000)
        .map(|_| [component(), component(), component(), 0.0])
        .collect();
    directions.extend([[0.0, 0.0, 1.0, 0.0], [0.0, 0.0, -1.0, 0.0]]);
    directions.extend([[-1.0, 0.0, 0.0, 0.0], [0.0, -1.0, 0.0, 0.0]]);
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let batch = Batch::<[f32; 4], [f32; 4]>::new(&gpu, "rays.wgsl", SHADER).unwrap();
    for (direction, found) in directions.iter().zip(batch.run(&directions).unwrap()) {
        let [x, y, z, _] = direction.map(f64::from);
        let radius = x.hypot(y);
        let exact = [radius, y.atan2(x), radius.atan2(z), radius.hypot(z)];
        for (found, exact) in found.iter().zip(exact) {
            let error = (f64::from(*found) - exact).abs() / ulp(exact);
            assert!(
                error <= ULPS,
                "{direction:?}: {found} for {exact}, {error} ulp"
            );
        }
    }
    // No direction at all has angles, too.
    assert_eq!(batch.run(&[[0.0; 4]]).unwrap(), [[0.0; 4]]);
}
