//! The gradient of moment depth on a receiver's plane, from two points beside the receiver: that of the plane they were taken from.

use bytemuck::{Pod, Zeroable};
use glam::{DMat2, DVec2};
use moment_shadows::Profile;
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

const SHADER: &str = "
import moment_shadows::shade::receiver_bias::{receiver_bias_plane};

struct BatchInput {
    difference_x: vec4f,
    difference_y: vec4f,
}

alias BatchOutput = vec2f;

fn batch(input: BatchInput) -> vec2f {
    return receiver_bias_plane(input.difference_x.xyz, input.difference_y.xyz);
}
";

/// How far the two points are from the receiver: in texels, and in moment depth.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Input {
    difference_x: [f32; 4],
    difference_y: [f32; 4],
}

fn run(inputs: &[Input]) -> Vec<[f32; 2]> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    Batch::new(&gpu, "planes.wgsl", SHADER)
        .unwrap()
        .run(inputs)
        .unwrap()
}

#[test]
fn a_gradient_is_that_of_the_plane() {
    let mut random = ChaCha8Rng::seed_from_u64(74);
    let mut gradients = Vec::new();
    let mut inputs = Vec::new();
    while inputs.len() < 2000 {
        // A pixel covers any part of a texel, and many texels.
        let pixel = 10_f64.powf(random.random_range(-5.0..3.0));
        let mut vector = |length: f64| {
            let mut within = || length * random.random_range(-1.0..1.0_f64);
            DVec2::new(within(), within())
        };
        let [x, y, gradient] = [vector(pixel), vector(pixel), vector(1.0)];
        // Of points nearly on a line little is left but rounding.
        if DMat2::from_cols(x, y).determinant().abs() < 0.1 * x.length() * y.length() {
            continue;
        }
        let point = |at: DVec2| [at.x as f32, at.y as f32, gradient.dot(at) as f32, 0.0];
        gradients.push(gradient);
        inputs.push(Input {
            difference_x: point(x),
            difference_y: point(y),
        });
    }
    for ((found, gradient), input) in run(&inputs).iter().zip(gradients).zip(&inputs) {
        let off = DVec2::from(found.map(f64::from)).distance(gradient);
        // Tens of roundings of 6e-8, ten times as much where the points are so near to a line.
        assert!(
            off < 2e-5 * gradient.length(),
            "{off} {gradient}: {input:?}"
        );
    }
}

#[test]
fn without_a_plane_a_gradient_is_as_long_as_that_of_a_surface_seen_edge_on() {
    let inputs: Vec<Input> = [
        // No neighbours, one alone, and three points on a line.
        ([0.0; 3], [0.0; 3]),
        ([0.5, -2.0, 0.25], [0.0; 3]),
        ([0.5, -2.0, 0.25], [-1.0, 4.0, 0.125]),
        ([512.0, 1024.0, 2.0], [1024.0, 2048.0, -2.0]),
    ]
    .into_iter()
    .map(|([x, y, z], [u, v, w])| Input {
        difference_x: [x, y, z, 0.0],
        difference_y: [u, v, w, 0.0],
    })
    .collect();
    for (found, input) in run(&inputs).iter().zip(&inputs) {
        // RECEIVER_BIAS_EDGE_ON, to which `receiver_bias_depth` limits it.
        let length = f64::from(found[0]).hypot(f64::from(found[1]));
        assert!((length / 1e15 - 1.0).abs() < 1e-6, "{found:?}: {input:?}");
    }
}
