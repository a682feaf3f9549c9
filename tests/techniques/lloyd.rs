//! Lloyd relaxation: splits go in front of the farther plane of an edge, and empty ones to where they are of use.

use bytemuck::{Pod, Zeroable};
use moment_shadows::Profile;
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::mixture::Layers;

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Input {
    layers: Layers,
    normal: [f32; 2],
    offset: f32,
    frames: u32,
    planes: [f32; 4],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Output {
    splits: [f32; 8],
    weights: [f32; 8],
}

fn run(inputs: &[Input]) -> Vec<Output> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    Batch::new(&gpu, "lloyd.wgsl", include_str!("lloyd.wgsl"))
        .unwrap()
        .run(inputs)
        .unwrap()
}

/// Where an edge between two planes wants a split: a sixth of the gap in front of the farther one.
fn wanted([near, far]: [f32; 2]) -> f32 {
    far - (far - near) / 6.0
}

/// An edge through the middle of the map between two planes.
fn edge(layers: Layers, angle: f32, [near, far]: [f32; 2]) -> Input {
    let normal = [angle.cos(), angle.sin()];
    Input {
        layers,
        normal,
        offset: 15.5 * (normal[0] + normal[1]),
        frames: 8,
        planes: [near, far, near, far],
    }
}

#[test]
fn an_axis_aligned_edge_takes_the_split_in_front_of_the_farther_plane() {
    let inputs: Vec<Input> = [[-0.5_f32, 0.25], [-0.875, -0.75], [0.0, 1.0]]
        .into_iter()
        .map(|planes| edge(Layers::new(&[0.1], 0.0), 0.0, planes))
        .collect();
    for (input, output) in inputs.iter().zip(run(&inputs)) {
        // A square root of a square, and a quotient of sums of 30 equal terms.
        let error = (output.splits[0] - wanted([input.planes[0], input.planes[1]])).abs();
        assert!(error <= 2e-6, "{input:?}: off by {error:e}");
        assert!(output.weights[0] > 0.0);
    }
}

#[test]
fn edges_of_any_direction_take_it_in_front_of_the_farther_plane() {
    let mut random = ChaCha8Rng::seed_from_u64(413);
    let inputs: Vec<Input> = (0..500)
        .map(|_| {
            let near = random.random_range(-1.0..0.5_f32);
            let far = random.random_range(near + 0.05..0.9);
            let angle = random.random_range(0.0..core::f32::consts::TAU);
            edge(Layers::new(&[0.1], 0.0), angle, [near, far])
        })
        .collect();
    let largest = inputs
        .iter()
        .zip(run(&inputs))
        .map(|(input, output)| {
            let gap = input.planes[1] - input.planes[0];
            ((output.splits[0] - wanted([input.planes[0], input.planes[1]])) / gap).abs()
        })
        .fold(0.0_f32, f32::max);
    println!("off by {largest:.1e} of the gap at most");
    // Footprints see two depths, whose first three moments tell both. Depths up to 1 have an error of 2^-24, the gap is 0.05
    // at least, and the third moment's error is some times theirs.
    assert!(largest <= 2e-5);
}

#[test]
fn two_edges_take_two_splits_and_an_empty_cell_sends_its_split_elsewhere() {
    // All splits but one begin in front of everything.
    let layers = [
        Layers::new(&[-0.5, 0.5], 0.0),
        Layers::new(&[-0.99, -0.98], 0.0),
        Layers::new(&[0.98, 0.99], 0.0),
        Layers::new(&[-0.99, -0.98, -0.97], 0.0),
        Layers::new(&[-0.9, -0.8, -0.7, 0.6, 0.7, 0.8, 0.9], 0.0),
    ];
    let inputs = layers.map(|layers| Input {
        layers,
        normal: [1.0, 0.0],
        offset: 15.5,
        frames: 64,
        planes: [-0.75, -0.25, 0.25, 0.625],
    });
    for (input, output) in inputs.iter().zip(run(&inputs)) {
        let count = input.layers.count as usize - 1;
        let splits = &output.splits[..count];
        println!("{:?} became {splits:?}", &input.layers.splits[..count]);
        assert!(splits.is_sorted(), "{splits:?}");
        for place in [wanted([-0.75, -0.25]), wanted([0.25, 0.625])] {
            let nearest = splits
                .iter()
                .map(|split| (split - place).abs())
                .fold(2.0, f32::min);
            assert!(nearest <= 2e-6, "no split at {place}: {splits:?}");
        }
        // What is beyond the count stays.
        assert_eq!(output.splits[count..], input.layers.splits[count..]);
    }
}

#[test]
fn nothing_moves_without_an_edge_or_a_split() {
    let flat = edge(Layers::new(&[-0.5, 0.1, 0.5], 0.0), 0.3, [0.25, 0.25]);
    let single = edge(Layers::new(&[], 0.0), 0.3, [0.0, 0.5]);
    for (input, output) in [flat, single].iter().zip(run(&[flat, single])) {
        assert_eq!(output.splits, input.layers.splits);
    }
}
