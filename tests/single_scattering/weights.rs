//! The transmittance that serves all view rays of a row, and what that costs.

use glam::DVec3;
use moment_shadows::{Profile, RectifiedView};
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

use crate::cameras::{Pair, random_pair};

const SHADER: &str = "
import moment_shadows::air::rectified_frame::{RectifiedFrame, rectified_frame_ray};
import moment_shadows::air::scattering_weights::{scattering_weights_inclinations, scattering_weights_reference_sine};
struct BatchInput { frame: RectifiedFrame, row: f32, padding: f32, more: vec2f }
alias BatchOutput = vec4f;
fn batch(input: BatchInput) -> BatchOutput {
    let azimuth = rectified_frame_ray(input.frame, vec2f(0.0, input.row)).y;
    return vec4f(azimuth, scattering_weights_inclinations(input.frame, azimuth), scattering_weights_reference_sine(input.frame, azimuth));
}
";

/// Whether a direction in rectified space is that of a pixel, by the camera's matrix.
fn visible(pair: &Pair, view: &RectifiedView, direction: DVec3) -> bool {
    let axes = view.axes.map(DVec3::from_array);
    let scene = axes[0] * direction.x + axes[1] * direction.y + axes[2] * direction.z;
    let clip = pair.world_from_clip.inverse() * scene.extend(0.0);
    clip.w > 0.0 && clip.x.abs() <= clip.w && clip.y.abs() <= clip.w
}

#[test]
fn inclinations_of_a_row_are_those_of_its_view_rays() {
    const STEPS: usize = 4000;
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let batch = Batch::<[f32; 24], [f32; 4]>::new(&gpu, "weights.wgsl", SHADER).unwrap();
    let mut random = ChaCha8Rng::seed_from_u64(9);
    let mut judged = 0;
    for _ in 0..150 {
        let pair = random_pair(&mut random);
        let view = RectifiedView::new(&pair.clip_from_world, pair.far, pair.light).unwrap();
        let inputs: Vec<[f32; 24]> = [0.05, 0.3, 0.5, 0.8]
            .into_iter()
            .map(|row| {
                let mut input = [0.0; 24];
                input[..20].copy_from_slice(bytemuck::cast_slice(&[view.frame]));
                input[20] = row;
                input
            })
            .collect();
        for found in batch.run(&inputs).unwrap() {
            let [azimuth, low, high, reference] = found.map(f64::from);
            let (sine, cosine) = azimuth.sin_cos();
            let step = core::f64::consts::PI / STEPS as f64;
            let seen: Vec<f64> = (0..=STEPS)
                .map(|index| index as f64 * step)
                .filter(|theta| {
                    let (s, c) = theta.sin_cos();
                    visible(&pair, &view, DVec3::new(s * cosine, s * sine, c))
                })
                .collect();
            // Rows that graze the frustum have no view rays to speak of.
            let (Some(&first), Some(&last), true) = (seen.first(), seen.last(), seen.len() > 4)
            else {
                continue;
            };
            judged += 1;
            assert!(
                (low - first).abs() <= 1.01 * step && (high - last).abs() <= 1.01 * step,
                "{pair:?}: {low} to {high}, not {first} to {last}"
            );
            let sines = seen.iter().map(|theta| theta.sin());
            let largest = sines.clone().fold(0.0, f64::max);
            let expected = 0.5 * (sines.fold(1.0, f64::min) + largest);
            assert!(
                (reference - expected).abs() <= 2.0 * step,
                "{reference}, not {expected}"
            );
        }
    }
    assert!(judged > 400, "{judged}");
}

/// The share of the light up to `thickness` that an occluder from optical depth `from` on takes away, weighted with a rate that
/// is `ratio` times the true one.
fn share(from: f64, thickness: f64, ratio: f64) -> f64 {
    let part = |x: f64| {
        if ratio * x < 1e-9 {
            ratio * x
        } else {
            -(-ratio * x).exp_m1()
        }
    };
    1.0 - part(from) / part(thickness)
}

/// The largest error over all occluders that begin somewhere on a ray of this optical thickness.
fn largest_error(thickness: f64, ratio: f64) -> f64 {
    (0..=400)
        .map(|step| f64::from(step) / 400.0 * thickness)
        .map(|from| (share(from, thickness, ratio) - share(from, thickness, 1.0)).abs())
        .fold(0.0, f64::max)
}

/// What the module's table says, for thicknesses 0.1, 1, 2 and 5.
const TABLE: [(f64, [f64; 4]); 4] = [
    (1.2, [0.001, 0.011, 0.020, 0.033]),
    (1.5, [0.003, 0.024, 0.045, 0.076]),
    (2.0, [0.004, 0.041, 0.076, 0.133]),
    (4.0, [0.008, 0.074, 0.140, 0.263]),
];

#[test]
fn the_mean_sine_has_the_stated_error_and_no_choice_is_much_better() {
    for (spread, stated) in TABLE {
        for (thickness, stated) in [0.1, 1.0, 2.0, 5.0].into_iter().zip(stated) {
            // Rates are extinction / sine: rays of sines 1 / spread to 1, and weights for a sine in between.
            let worst = |reference: f64| {
                (0..=20)
                    .map(|step| 1.0 / spread + (1.0 - 1.0 / spread) * f64::from(step) / 20.0)
                    .map(|sine| largest_error(thickness, sine / reference))
                    .fold(0.0, f64::max)
            };
            let mean = worst(0.5 * (1.0 + 1.0 / spread));
            let best = (0..=40)
                .map(|step| worst(1.0 / spread + (1.0 - 1.0 / spread) * f64::from(step) / 40.0))
                .fold(1.0, f64::min);
            let none = largest_error(thickness, 1e-6);
            println!(
                "sines 1:{spread}, thickness {thickness}: {mean:.4}, at best {best:.4}, unweighted {none:.4}"
            );
            assert!((mean - stated).abs() <= 6e-4, "{mean}, not {stated}");
            assert!(mean <= 1.17 * best, "{mean}, at best {best}");
            assert!(mean < 0.7 * none);
        }
    }
}

/// What the module says of weights with a tilt, for the same thicknesses.
const TILTED: [(f64, [f64; 4]); 4] = [
    (1.2, [0.000, 0.000, 0.001, 0.004]),
    (1.5, [0.000, 0.001, 0.003, 0.026]),
    (2.0, [0.000, 0.001, 0.009, 0.118]),
    (4.0, [0.000, 0.006, 0.036, 0.244]),
];

const TILT: &str = "
import moment_shadows::air::rectified_frame::{RectifiedFrame};
import moment_shadows::air::scattering_weights::{scattering_weights_tilt};
struct BatchInput { thickness: f32, of_row: f32 }
alias BatchOutput = f32;
fn batch(input: BatchInput) -> BatchOutput {
    var frame: RectifiedFrame;
    frame.largest_radius = 3.0;
    // The extinction that gives view rays of the sine 1/4 that thickness where they end, in the column after 5 of 12.
    let extinction = input.thickness * 0.25 / (3.0 * 6.5 / 12.0);
    return scattering_weights_tilt(frame, extinction, input.of_row / 6.5, 0.25, 5.0, 12.0);
}
";

#[test]
fn a_tilt_gives_view_rays_nearly_their_own_weights() {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let batch = Batch::<[f32; 2], f32>::new(&gpu, "tilt.wgsl", TILT).unwrap();
    for (spread, stated) in TILTED {
        for (thickness, stated) in [0.1, 1.0, 2.0, 5.0].into_iter().zip(stated) {
            let reference = 0.5 * (1.0 + 1.0 / spread);
            let of_row = (0..=20)
                .map(|step| 1.0 / spread + (1.0 - 1.0 / spread) * f64::from(step) / 20.0)
                .map(|sine| thickness * sine / reference);
            let inputs: Vec<[f32; 2]> = of_row.map(|row| [thickness as f32, row as f32]).collect();
            let mut worst = 0.0_f64;
            for (input, tilt) in inputs.iter().zip(batch.run(&inputs).unwrap()) {
                // Both cumulative, in steps of the way to the end.
                const STEPS: usize = 4000;
                let (mut own, mut tilted) = (vec![0.0], vec![0.0]);
                for step in 0..STEPS {
                    let at = (step as f64 + 0.5) / STEPS as f64;
                    let line = 1.0 + f64::from(tilt) * (0.5 - at);
                    own.push(own[step] + (-thickness * at).exp());
                    tilted.push(tilted[step] + line * (-f64::from(input[1]) * at).exp());
                }
                let shares = own.iter().zip(&tilted);
                let apart = shares.map(|(a, b)| (a / own[STEPS] - b / tilted[STEPS]).abs());
                worst = apart.fold(worst, f64::max);
            }
            println!("sines 1:{spread}, thickness {thickness}: {worst:.4}");
            assert!((worst - stated).abs() <= 6e-4, "{worst}, not {stated}");
        }
    }
}

#[test]
fn a_tilt_is_a_number_within_its_limits() {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let batch = Batch::<[f32; 2], f32>::new(&gpu, "tilt.wgsl", TILT).unwrap();
    let inputs = [
        [1e38, 0.0],
        [0.0, 1e38],
        [1e38, 1e38],
        [-1.0, 0.0],
        [0.0, 0.0],
    ];
    let found = batch.run(&inputs).unwrap();
    assert_eq!(found[..2], [2.0, -2.0]);
    assert!((-2.0..=2.0).contains(&found[2]), "{found:?}");
    assert_eq!(found[3..], [0.0, 0.0]);
}
