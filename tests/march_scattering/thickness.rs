//! Optical thickness of height fog, and density that is none.

use glam::DVec3;
use moment_shadows::{HeightFog, Profile};
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::quadrature::integral;

/// Gradient and logarithm of density; start; direction and length.
type Stretch = [[f32; 4]; 3];

const SHADER: &str = "
import moment_shadows::air::height_fog::{HeightFog, height_fog_thickness};
import moment_shadows::air::march::{march_thickness};
alias BatchInput = array<vec4f, 3>;
alias BatchOutput = vec2f;
fn batch(input: BatchInput) -> vec2f {
    let fog = HeightFog(input[0].xyz, input[0].w);
    return vec2f(height_fog_thickness(fog, input[1].xyz, input[2].xyz, input[2].w), march_thickness(input[0].w, input[2].w));
}
";

fn run(stretches: &[Stretch]) -> Vec<[f32; 2]> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    Batch::new(&gpu, "thickness.wgsl", SHADER)
        .unwrap()
        .run(stretches)
        .unwrap()
}

/// Its thickness, and the largest number that is rounded on the way to a logarithm of density.
fn truth([fog, start, ray]: &Stretch) -> (f64, f64) {
    let vector = |it: &[f32; 4]| DVec3::new(it[0].into(), it[1].into(), it[2].into());
    let [log_density, length] = [fog[3], ray[3]].map(f64::from);
    let rate = |at: DVec3| vector(fog).dot(at);
    let density = |part: f64| {
        let at = vector(start) + part * length * vector(ray);
        (log_density - rate(at)).exp()
    };
    let terms = log_density.abs() + rate(vector(start)).abs() + (length * rate(vector(ray))).abs();
    (length * integral(&density, 0.0, 1.0, 1e-9), terms)
}

#[test]
fn thickness_is_that_of_quadrature_whichever_way_a_ray_goes() {
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let mut number = |limit: f32| random.random_range(-limit..limit);
    let mut stretches: Vec<Stretch> = (0..3000)
        .map(|_| {
            let gradient = [number(0.5), number(0.5), number(0.5), number(3.0)];
            let start = [number(20.0), number(20.0), number(20.0), 0.0];
            let way = DVec3::new(number(1.0).into(), number(1.0).into(), number(1.0).into());
            let [x, y, z] = way.normalize().as_vec3().to_array();
            [gradient, start, [x, y, z, 20.0 * number(1.0).abs()]]
        })
        .collect();
    // Level rays, almost level ones, far above the fog and down into it, and of one density.
    for [x, y] in [
        [1.0, 0.0],
        [1.0, 1e-7],
        [1.0, -1e-7],
        [0.0, -1.0],
        [0.0, 1.0],
    ] {
        for log_density in [0.0, -30.0, 5.0] {
            for falloff in [0.0, 1e-6, 0.3, 2.0] {
                stretches.push([
                    [0.0, falloff, 0.0, log_density],
                    [0.0; 4],
                    [x, y, 0.0, 12.0],
                ]);
            }
        }
    }
    for (stretch, [found, _]) in stretches.iter().zip(run(&stretches)) {
        let (truth, terms) = truth(stretch);
        let relative = f64::from(found) / truth - 1.0;
        // Rounding of the logarithm, and a dozen roundings.
        let tolerance = 1.5e-6 + 2.4e-7 * terms;
        assert!(relative.abs() <= tolerance, "{relative} {stretch:?}");
    }
}

#[test]
fn no_density_and_impossible_densities_have_no_thickness() {
    let none = [
        0.0,
        -0.0,
        -1.0,
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        -1e38,
    ];
    let stretches = none.map(|density| [[0.0, 0.0, 0.0, density], [0.0; 4], [0.0, 0.0, 1.0, 7.0]]);
    for ([_, found], density) in run(&stretches).into_iter().zip(none) {
        assert_eq!(found.to_bits(), 0, "{density}");
    }
    // Of the fog's own: what is no number is no fog; the densest there is stays finite.
    let numbers = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY];
    for place in 0..4 {
        let stretches = numbers.map(|number| {
            let mut fog = [0.0, 0.1, 0.0, 0.0];
            fog[place] = number;
            [fog, [1.0, 2.0, 3.0, 0.0], [0.6, 0.0, 0.8, 7.0]]
        });
        for ([found, _], number) in run(&stretches).into_iter().zip(numbers) {
            assert_eq!(found.to_bits(), 0, "{number} at {place}");
        }
    }
    let extremes = [
        [0.0, 0.0, 0.0, 1e9],
        [0.0, 1e9, 0.0, 1e9],
        [0.0, 1e9, 0.0, -1e9],
    ];
    for fog in extremes {
        for y in [1.0, 0.0, -1.0] {
            let [found, _] = run(&[[fog, [0.0; 4], [1.0 - f32::abs(y), y, 0.0, 1e9]]])[0];
            assert!((0.0..=1e18).contains(&found), "{found} {fog:?} {y}");
        }
    }
}

#[test]
fn fog_that_cannot_be_is_refused_by_name() {
    let fog = HeightFog {
        height: 2.0,
        falloff: 0.25,
        ..HeightFog::NONE
    };
    let cases = [
        (
            HeightFog {
                up: [0.0; 3],
                ..fog
            },
            "up",
        ),
        (
            HeightFog {
                up: [f64::NAN, 1.0, 0.0],
                ..fog
            },
            "up",
        ),
        (
            HeightFog {
                height: f64::NAN,
                ..fog
            },
            "height",
        ),
        (
            HeightFog {
                falloff: -0.1,
                ..fog
            },
            "falloff",
        ),
        (
            HeightFog {
                falloff: f64::NAN,
                ..fog
            },
            "falloff",
        ),
        (
            HeightFog {
                falloff: 1e10,
                ..fog
            },
            "falloff",
        ),
    ];
    for (fog, name) in cases {
        assert_eq!(fog.view([0.0; 3]).unwrap_err().name, name);
    }
    // Eight units above the height of full density, e^-2 of it is left.
    let view = fog.view([5.0, 10.0, 5.0]).unwrap();
    assert_eq!((view.gradient, view.log_density), ([0.0, 0.25, 0.0], -2.0));
}
