//! Rays without shadows through height fog, lit by every kind of light: the module `march` against quadrature.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;
use moment_shadows::{Profile, SingleScattering};
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::quadrature::integral;

/// A ray from the camera, a light and what is in the air.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Ray {
    pub(crate) direction: [f32; 3],
    pub(crate) length: f32,
    pub(crate) gradient: [f32; 3],
    pub(crate) log_density: f32,
    pub(crate) place: [f32; 3],
    pub(crate) radius: f32,
    pub(crate) cone_axis: [f32; 3],
    pub(crate) cone_offset: f32,
    pub(crate) medium: SingleScattering,
    pub(crate) steps: u32,
    /// The density of the host, and 1 where it has one.
    pub(crate) density: f32,
    pub(crate) has_density: u32,
    pub(crate) padding: u32,
}

/// What a host's own shader does, without a map.
const SHADER: &str = "
import moment_shadows::air::height_fog::{HeightFog, height_fog_thickness};
import moment_shadows::air::march::{March, march_begin, march_falloff, march_place, march_step, march_steps, march_thickness, march_transmittance};
import moment_shadows::air::phase_function::{phase_function_henyey_greenstein};
import moment_shadows::air::punctual_light::{PunctualLight, punctual_light_at, punctual_light_cone, punctual_light_interval};
import moment_shadows::air::single_scattering::{SingleScattering, SingleScatteringRay, single_scattering_pixel};
struct BatchInput {
    direction: vec3f,
    length: f32,
    fog: HeightFog,
    light: PunctualLight,
    medium: SingleScattering,
    steps: u32,
    density: f32,
    has_density: u32,
}
alias BatchOutput = vec4f;
fn batch(input: BatchInput) -> vec4f {
    let direction = input.direction;
    let whole = height_fog_thickness(input.fog, vec3f(0.0), direction, input.length);
    let interval = punctual_light_interval(input.light, direction, input.length);
    var march = march_begin();
    march.transmittance = march_transmittance(input.medium, height_fog_thickness(input.fog, vec3f(0.0), direction, max(interval.x, 0.0)));
    let steps = march_steps(input.light, direction, interval);
    let count = select(f32(input.steps), 0.0, interval.y <= interval.x);
    for (var step = 0.0; step < count; step += 1.0) {
        let start = march_place(steps, step / count);
        let length = march_place(steps, (step + 1.0) / count) - start;
        let position = march_place(steps, (step + 0.5) / count) * direction;
        let at = punctual_light_at(input.light, position);
        var light = phase_function_henyey_greenstein(-dot(at.xyz, direction), input.medium.anisotropy) * input.medium.irradiance;
        light *= punctual_light_cone(input.light, at.xyz) * march_falloff(steps, input.light.radius, length, count);
        light *= march_transmittance(input.medium, height_fog_thickness(input.fog, position, -at.xyz, at.w));
        var thickness = height_fog_thickness(input.fog, start * direction, direction, length);
        if input.has_density == 1u {
            thickness = march_thickness(input.density, length);
        }
        march = march_step(march, input.medium, thickness, light);
    }
    var transmittance = march_transmittance(input.medium, whole);
    if input.has_density == 1u {
        transmittance = march.transmittance;
    }
    return single_scattering_pixel(SingleScatteringRay(march.radiance, transmittance));
}
";

pub(crate) fn run(rays: &[Ray]) -> Vec<[f32; 4]> {
    run_by(SHADER, rays)
}

fn run_by(shader: &str, rays: &[Ray]) -> Vec<[f32; 4]> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    Batch::new(&gpu, "rays.wgsl", shader)
        .unwrap()
        .run(rays)
        .unwrap()
}

/// Thin haze, the same for all colours but for its strength.
pub(crate) fn haze(extinction: f32) -> SingleScattering {
    let extinction = [0.5, 1.0, 2.0].map(|colour| colour * extinction);
    let scattering = extinction.map(|it| 0.9 * it);
    SingleScattering::new(extinction, scattering, 0.4, [3.0, 2.0, 1.0]).unwrap()
}

/// A ray in air of one density, lit from everywhere along x.
pub(crate) fn plain() -> Ray {
    Ray {
        direction: [0.0, 0.0, 1.0],
        length: 20.0,
        gradient: [0.0; 3],
        log_density: 0.0,
        place: [1.0, 0.0, 0.0],
        radius: 0.0,
        cone_axis: [0.0; 3],
        cone_offset: 1.0,
        medium: haze(0.05),
        steps: 64,
        density: 0.0,
        has_density: 0,
        padding: 0,
    }
}

impl Ray {
    /// Radiance by colour, by nested quadrature.
    fn truth(&self) -> [f64; 3] {
        let vector = |it: [f32; 3]| DVec3::from(it.map(f64::from));
        let (direction, gradient) = (vector(self.direction), vector(self.gradient));
        let density = |at: DVec3| (f64::from(self.log_density) - gradient.dot(at)).exp();
        let thickness = |from: DVec3, to: DVec3| {
            let along = |part: f64| density(from + part * (to - from));
            (to - from).length() * integral(&along, 0.0, 1.0, 1e-7)
        };
        [0, 1, 2].map(|colour| {
            let [extinction, scattering, irradiance] = [
                self.medium.extinction,
                self.medium.scattering,
                self.medium.irradiance,
            ]
            .map(|it| f64::from(it[colour]));
            let radiance = |distance: f64| {
                let at = distance * direction;
                let (light, falloff, path) = if self.radius == 0.0 {
                    (vector(self.place), 1.0, 0.0)
                } else {
                    let from = at - vector(self.place);
                    let square = from.length_squared() + f64::from(self.radius).powi(2);
                    let path = thickness(vector(self.place), at);
                    (from.normalize_or_zero(), 1.0 / square, path)
                };
                let cone = light.dot(vector(self.cone_axis)) + f64::from(self.cone_offset);
                let cone = cone.clamp(0.0, 1.0).powi(2);
                let g = f64::from(self.medium.anisotropy);
                let cosine = -light.dot(direction);
                let phase = (1.0 - g * g) / (1.0 + g * g - 2.0 * g * cosine).powf(1.5);
                let dimmed = (-extinction * (thickness(DVec3::ZERO, at) + path)).exp();
                phase / (4.0 * core::f64::consts::PI) * cone * falloff * density(at) * dimmed
            };
            scattering * irradiance * integral(&radiance, 0.0, f64::from(self.length), 1e-5)
        })
    }
}

/// A ray among fog that rises, falls or is level, in front of a light of a kind.
fn random(random: &mut ChaCha8Rng, kind: usize) -> Ray {
    let mut unit = || {
        let vector = [0; 3].map(|_| random.random_range(-1.0..1.0_f32));
        DVec3::from(vector.map(f64::from))
            .normalize()
            .as_vec3()
            .to_array()
    };
    let (direction, place, axis) = (unit(), unit(), unit());
    let mut ray = Ray {
        direction,
        gradient: [0.0, random.random_range(0.0..0.6), 0.0],
        log_density: random.random_range(-1.0..0.5),
        length: random.random_range(2.0..30.0),
        place,
        ..plain()
    };
    ray.medium = haze(random.random_range(0.1..1.0) / ray.length);
    if kind > 0 {
        // Around the ray's middle, so that many pass it closely.
        let away = random.random_range(0.2..8.0);
        ray.place = [0, 1, 2].map(|axis| 0.4 * ray.length * direction[axis] + away * place[axis]);
        ray.radius = ray.length / 1024.0;
    }
    if kind > 1 {
        let [inner, outer] = [0.7_f32, 1.2].map(|angle| (0.5 * angle).cos());
        let scale = 1.0 / (inner - outer);
        ray.cone_axis = axis.map(|it| scale * it);
        ray.cone_offset = -scale * outer;
    }
    ray
}

/// The mean error as a part of the mean radiance.
fn error(found: &[[f32; 4]], truths: &[[f64; 3]]) -> f64 {
    let pairs = found.iter().zip(truths);
    let off = pairs.flat_map(|(found, truth)| {
        [0, 1, 2].map(|colour| (f64::from(found[colour]) - truth[colour]).abs())
    });
    off.sum::<f64>() / truths.iter().flatten().sum::<f64>()
}

#[test]
fn steps_of_equal_angles_need_fewer_than_those_of_equal_lengths() {
    // Steps without a nearest point are equally long; their light is that of their middle.
    let lengths = SHADER
        .replace("let steps = march_steps(", "var steps = march_steps(")
        .replace("let count =", "steps.across = 0.0;\n    let count =")
        .replace(
            "march_falloff(steps, input.light.radius, length, count)",
            "(1.0 / (at.w * at.w + input.light.radius * input.light.radius))",
        );
    // Optical thickness of the ray, and the errors, which the module states rounded, to a tenth of them for rounding on other devices.
    for (thickness, stated) in [
        (0.5, [0.023, 0.27]),
        (2.0, [0.105, 0.29]),
        (8.0, [0.52, 0.3]),
    ] {
        let mut source = ChaCha8Rng::seed_from_u64(10);
        let rays: Vec<Ray> = (0..100)
            .map(|_| {
                let ray = random(&mut source, 1);
                Ray {
                    gradient: [0.0; 3],
                    log_density: 0.0,
                    steps: 8,
                    medium: haze(thickness / ray.length),
                    ..ray
                }
            })
            .collect();
        let truths: Vec<[f64; 3]> = rays.iter().map(Ray::truth).collect();
        let [angles, lengths] =
            [SHADER, &lengths].map(|shader| error(&run_by(shader, &rays), &truths));
        println!("thickness {thickness}: {angles:.3} by angles, {lengths:.3} by lengths");
        for (found, stated) in [angles, lengths].iter().zip(stated) {
            assert!((found / stated - 1.0).abs() < 0.1, "{thickness}: {found}");
        }
    }
}

#[test]
fn more_steps_come_nearer_to_quadrature_for_every_light() {
    let mut source = ChaCha8Rng::seed_from_u64(7);
    for (kind, name) in ["directional", "point", "spot"].into_iter().enumerate() {
        let rays: Vec<Ray> = (0..24).map(|_| random(&mut source, kind)).collect();
        let truths: Vec<[f64; 3]> = rays.iter().map(Ray::truth).collect();
        let errors = [16, 64, 256].map(|steps| {
            let rays: Vec<Ray> = rays.iter().map(|&ray| Ray { steps, ..ray }).collect();
            error(&run(&rays), &truths)
        });
        println!("{name}: {errors:?}");
        // Of the second order, down to rounding, which is all that a light of one direction has.
        assert!(errors[0] < 0.04 && errors[2] < 4e-4, "{name}: {errors:?}");
        assert!(errors[1] < 0.12 * errors[0] + 5e-6, "{name}: {errors:?}");
        assert!(kind > 0 || errors[0] < 5e-6, "{name}: {errors:?}");
    }
}

#[test]
fn a_directional_light_in_plain_air_is_exact_with_one_step() {
    let mut source = ChaCha8Rng::seed_from_u64(8);
    for _ in 0..8 {
        let ray = Ray {
            gradient: [0.0; 3],
            steps: 1,
            ..random(&mut source, 0)
        };
        let found = run(&[ray])[0];
        for (found, truth) in found.iter().zip(ray.truth()) {
            let relative = f64::from(*found) / truth - 1.0;
            assert!(relative.abs() < 1e-5, "{relative} {ray:?}");
        }
    }
}
