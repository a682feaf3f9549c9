//! The part of a view ray within a spot's cone.

use glam::DVec3;
use moment_shadows::Profile;
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const SHADER: &str = "
import moment_shadows::air::punctual_light::{PunctualLight, punctual_light_interval};
alias BatchInput = array<vec4f, 3>;
alias BatchOutput = vec2f;
fn batch(input: BatchInput) -> vec2f {
    let light = PunctualLight(input[0].xyz, input[0].w, input[1].xyz, input[1].w);
    return punctual_light_interval(light, input[2].xyz, input[2].w);
}
";

#[test]
fn nothing_lit_is_cut_off_and_little_else_is_kept() {
    let mut source = ChaCha8Rng::seed_from_u64(5);
    let mut unit = || {
        let vector = [0; 3].map(|_| source.random_range(-1.0..1.0));
        DVec3::from(vector).normalize().as_vec3()
    };
    let sizes = [1e-3_f32, 1.0, 1e4];
    let cases: Vec<([[f32; 4]; 3], f64)> = (0..4000)
        .map(|number: usize| {
            let size = sizes[number % 3];
            let angle: f32 = [0.2, 1.0, 2.2, 3.0][number % 4];
            let mut place = (unit() * size).to_array();
            let (axis, mut direction) = (unit(), unit());
            match number % 11 {
                // Along the axis, along the cone's side, from within the light.
                0 => direction = axis,
                // With the module's slack one end lies as far away as rounding has it.
                side @ (1 | 3) => {
                    let aside = axis.any_orthonormal_vector();
                    let cosine = (0.5 * angle).cos() - if side == 3 { 1e-3 } else { 0.0 };
                    direction = axis * cosine + aside * (1.0 - cosine * cosine).sqrt();
                }
                2 => place = [0.0; 3],
                _ => {}
            }
            let outer = (0.5 * angle).cos();
            let scale = 1.0 / ((0.4 * angle).cos() - outer);
            let [x, y, z] = place;
            let [a, b, c] = (scale * axis).to_array();
            let [u, v, w] = direction.normalize().to_array();
            let case = [
                [x, y, z, 0.01 * size],
                [a, b, c, -scale * outer],
                [u, v, w, 4.0 * size],
            ];
            (case, f64::from(outer))
        })
        .collect();
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let batch = Batch::new(&gpu, "cones.wgsl", SHADER).unwrap();
    let inputs: Vec<_> = cases.iter().map(|(case, _)| *case).collect();
    let found: Vec<[f32; 2]> = batch.run(&inputs).unwrap();
    let (mut kept, mut lit) = (0.0, 0.0);
    for (([place, axis, ray], outer), [near, far]) in cases.iter().zip(found) {
        let vector = |it: &[f32; 4]| DVec3::new(it[0].into(), it[1].into(), it[2].into());
        let [near, far, length] = [near, far, ray[3]].map(f64::from);
        kept += (far - near).max(0.0) / length;
        for step in 0..200 {
            let distance = length * (f64::from(step) + 0.5) / 200.0;
            let from = (distance * vector(ray) - vector(place)).normalize_or_zero();
            // A hundredth within the cone's border nothing is lit yet to be seen.
            let inside = from.dot(vector(axis).normalize()) > outer + 1e-5;
            lit += f64::from(inside) / 200.0;
            let is_kept = distance >= near && distance <= far;
            assert!(
                is_kept || !inside,
                "{distance} of {near} to {far}: {place:?} {axis:?} {ray:?}"
            );
        }
    }
    println!("kept {kept}, lit {lit}");
    assert!(kept < 1.02 * lit, "{kept} {lit}");
}
