//! An empty split halves the heaviest cell, and the list stays in order: as taking it out, adding another one and sorting has it.

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
    weights: [f32; 8],
    split: [u32; 4],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Output {
    splits: [f32; 8],
    weights: [f32; 8],
}

fn random_input(random: &mut ChaCha8Rng) -> Input {
    let count = random.random_range(2..8_usize);
    let mut splits: Vec<f32> = (0..count)
        .map(|_| random.random_range(-1.0..1.0_f32))
        .collect();
    splits.sort_by(f32::total_cmp);
    let empty = random.random_range(0..count);
    let mut weights = [0.0; 8];
    for weight in &mut weights[..count] {
        *weight = random.random_range(0.01..1.0_f32);
    }
    weights[empty] = 0.0;
    Input {
        layers: Layers::new(&splits, 0.0),
        weights,
        split: [empty as u32, 0, 0, 0],
    }
}

/// The splits with their weights afterwards.
fn expected(input: &Input) -> Vec<(f32, f32)> {
    let count = input.layers.count as usize - 1;
    let splits = &input.layers.splits[..count];
    let heaviest = (0..count)
        .max_by(|&a, &b| input.weights[a].total_cmp(&input.weights[b]))
        .unwrap();
    let own = splits[heaviest];
    // A cell reaches halfway to the next split, or to the end of the range.
    let before = heaviest
        .checked_sub(1)
        .map_or(own + 1.0, |it| 0.5 * (own - splits[it]));
    let after = splits
        .get(heaviest + 1)
        .map_or(1.0 - own, |next| 0.5 * (next - own));
    let moved = 0.5 * if after > before { after } else { -before };
    let mut all: Vec<_> = splits.iter().copied().zip(input.weights).collect();
    all[heaviest].1 *= 0.5;
    let half = all[heaviest].1;
    all[input.split[0] as usize] = (own + moved, half);
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    all
}

#[test]
fn an_empty_split_halves_the_heaviest_cell_and_keeps_the_order() {
    let mut random = ChaCha8Rng::seed_from_u64(414);
    let inputs: Vec<Input> = (0..2000).map(|_| random_input(&mut random)).collect();
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let outputs: Vec<Output> =
        Batch::new(&gpu, "lloyd_empty.wgsl", include_str!("lloyd_empty.wgsl"))
            .unwrap()
            .run(&inputs)
            .unwrap();
    for (input, output) in inputs.iter().zip(outputs) {
        let expected = expected(input);
        for (index, (split, weight)) in expected.iter().enumerate() {
            // Sums and halves of numbers of at most 2.
            assert!((output.splits[index] - split).abs() <= 3e-7, "{input:?}");
            assert_eq!(output.weights[index], *weight, "{input:?}");
        }
        let beyond = expected.len()..;
        assert_eq!(
            output.splits[beyond.clone()],
            input.layers.splits[beyond.clone()]
        );
        assert_eq!(output.weights[beyond.clone()], input.weights[beyond]);
    }
}
