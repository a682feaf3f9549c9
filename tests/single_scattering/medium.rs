//! Media out of range are refused by name; phase functions are normalised.

use moment_shadows::{Profile, SingleScattering};
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;

#[test]
fn impossible_media_are_refused() {
    let ones = [1.0; 3];
    for bad in [-1e-9, f32::NAN, f32::INFINITY] {
        let vector = [0.5, bad, 0.5];
        let errors = [
            (
                SingleScattering::new(vector, ones, 0.0, ones),
                "the extinction",
            ),
            (
                SingleScattering::new(ones, vector, 0.0, ones),
                "the scattering",
            ),
            (
                SingleScattering::new(ones, ones, 0.0, vector),
                "the irradiance",
            ),
            (
                SingleScattering::new(ones, ones, bad.signum() * 2.0, ones),
                "the anisotropy",
            ),
        ];
        for (found, name) in errors {
            let error = found.unwrap_err();
            assert_eq!(error.name, name);
            assert!(error.to_string().contains(name));
        }
    }
    // Zero extinction is a medium that scatters without loss.
    assert!(SingleScattering::new([0.0; 3], ones, 0.0, ones).is_ok());
    let none = SingleScattering::new([0.0; 3], [0.0; 3], 0.0, [0.0; 3]);
    assert_eq!(none, Ok(SingleScattering::NONE));
}

/// x = optical thickness or cosine, y = anisotropy.
const SHADER: &str = "
import moment_shadows::air::phase_function::{PHASE_FUNCTION_ISOTROPIC, phase_function_henyey_greenstein};
import moment_shadows::air::single_scattering::{single_scattering_mean_transmittance};
alias BatchInput = vec2f;
alias BatchOutput = vec4f;
fn batch(input: BatchInput) -> BatchOutput {
    let mean = single_scattering_mean_transmittance(vec3f(abs(input.x))).x;
    return vec4f(phase_function_henyey_greenstein(input.x, input.y), mean, PHASE_FUNCTION_ISOTROPIC, 0.0);
}
";

fn run(inputs: &[[f32; 2]]) -> Vec<[f32; 4]> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    Batch::new(&gpu, "medium.wgsl", SHADER)
        .unwrap()
        .run(inputs)
        .unwrap()
}

#[test]
fn phase_functions_integrate_to_one_and_favour_their_side() {
    const STEPS: usize = 200_000;
    for anisotropy in [-0.99_f32, -0.5, 0.0, 0.3, 0.9, 0.99] {
        let cosines: Vec<[f32; 2]> = (0..STEPS)
            .map(|step| {
                [
                    ((step as f64 + 0.5) / STEPS as f64 * 2.0 - 1.0) as f32,
                    anisotropy,
                ]
            })
            .collect();
        let found = run(&cosines);
        let step = 2.0 / STEPS as f64 * core::f64::consts::TAU;
        let integral: f64 = found.iter().map(|value| f64::from(value[0]) * step).sum();
        // Midpoints, whose cosines f32 rounds.
        assert!((integral - 1.0).abs() <= 2e-3, "{anisotropy}: {integral}");
        let [first, last] = [found[0][0], found[STEPS - 1][0]];
        assert_eq!(last > first, anisotropy > 0.0);
        if anisotropy == 0.0 {
            assert!(
                found.iter().all(|value| value[0] == value[2]),
                "isotropic to the bit"
            );
        }
    }
}

#[test]
fn mean_transmittance_is_exact_from_nothing_to_everything() {
    let inputs: Vec<[f32; 2]> = (0..20_000)
        .map(|step| [10.0_f32.powf(step as f32 / 20_000.0 * 12.0 - 8.0), 0.0])
        .chain([[0.0, 0.0], [0.5, 0.0], [0.499_999_97, 0.0]])
        .collect();
    for (input, found) in inputs.iter().zip(run(&inputs)) {
        let x = f64::from(input[0]);
        let exact = if x == 0.0 { 1.0 } else { -(-x).exp_m1() / x };
        // A dozen roundings.
        assert!(
            (f64::from(found[1]) / exact - 1.0).abs() <= 8e-7,
            "{x}: {}",
            found[1]
        );
    }
    assert_eq!(run(&[[0.0, 0.0]])[0][1], 1.0);
}

#[test]
fn overestimation_turns_from_the_upper_bound_to_the_lower_with_the_light() {
    const SHADER: &str = "
import moment_shadows::air::single_scattering::{single_scattering_shadow};
alias BatchInput = vec4f;
alias BatchOutput = f32;
fn batch(input: vec4f) -> f32 {
    return single_scattering_shadow(vec2f(0.25, 0.75), input.x, input.yz);
}
";
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let batch = Batch::<[f32; 4], f32>::new(&gpu, "overestimation.wgsl", SHADER).unwrap();
    // Against the light, across it and with it; rounding may leave the range.
    let cosines = [-1.0, -1.000_001, 0.0, 1.0, 1.000_001];
    let at = |[towards, away]: [f32; 2]| {
        batch
            .run(&cosines.map(|cosine| [cosine, towards, away, 0.0]))
            .unwrap()
    };
    assert_eq!(at([1.0, 1.0]), [0.75, 0.75, 0.5, 0.25, 0.25]);
    assert_eq!(at([0.0, 0.0]), [0.5; 5]);
    let half = at([0.5, 1.0]);
    assert_eq!([half[0], half[2], half[3]], [0.625, 0.5, 0.25]);
    let half = at([1.0, 0.5]);
    assert_eq!([half[0], half[2], half[3]], [0.75, 0.5, 0.375]);
}

#[test]
fn occluders_are_moved_a_little_away_from_the_light() {
    const SHADER: &str = "
import moment_shadows::air::single_scattering::{SINGLE_SCATTERING_DEPTH_BIAS, single_scattering_occluder_depth};
alias BatchInput = f32;
alias BatchOutput = vec2f;
fn batch(depth: f32) -> vec2f {
    return vec2f(single_scattering_occluder_depth(depth), SINGLE_SCATTERING_DEPTH_BIAS);
}
";
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let batch = Batch::<f32, [f32; 2]>::new(&gpu, "occluder_depth.wgsl", SHADER).unwrap();
    let depths: Vec<f32> = (0..=64).map(|step| step as f32 / 32.0 - 1.0).collect();
    let found = batch.run(&depths).unwrap();
    // Occluders in front of all view rays stay there, and those that shadow none, too.
    assert_eq!([found[0][0], found[64][0]], [-1.0, 1.0]);
    for (depth, [moved, bias]) in depths.iter().zip(&found) {
        assert!((0.01..0.1).contains(bias));
        // In front of a view ray that is as much nearer to the light.
        let expected = ((depth + bias) / (1.0 - bias)).min(1.0);
        assert!((moved - expected).abs() <= 3e-7, "{depth}: {moved}");
    }
}
