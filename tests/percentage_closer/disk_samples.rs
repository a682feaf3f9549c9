//! The samples of disks, and the noise that turns them.

use moment_shadows_lab::batch::Batch;

use crate::device;

const SHADER: &str = "
import moment_shadows::maths::disk_samples::{disk_samples_angle, disk_samples_poisson, disk_samples_rotation, disk_samples_vogel};

struct BatchInput {
    index: u32,
    // 0: the Poisson disk.
    count: u32,
    angle: f32,
    padding: f32,
}
alias BatchOutput = vec2f;

fn batch(input: BatchInput) -> BatchOutput {
    let rotation = disk_samples_rotation(input.angle);
    if input.count == 0u {
        return disk_samples_poisson(input.index, rotation);
    }
    if input.padding == 1.0 {
        return vec2f(disk_samples_angle(vec2f(vec2u(input.index, input.count))), 0.0);
    }
    return disk_samples_vogel(input.index, input.count, rotation);
}
";

#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Input {
    index: u32,
    count: u32,
    angle: f32,
    padding: f32,
}

fn run(inputs: &[Input]) -> Vec<[f32; 2]> {
    let gpu = device::open();
    Batch::<Input, [f32; 2]>::new(&gpu, "disk.wgsl", SHADER)
        .unwrap()
        .run(inputs)
        .unwrap()
}

fn samples(count: u32, angle: f32) -> Vec<[f32; 2]> {
    let samples = if count == 0 { 16 } else { count };
    let inputs: Vec<Input> = (0..samples)
        .map(|index| Input {
            index,
            count,
            angle,
            padding: 0.0,
        })
        .collect();
    run(&inputs)
}

/// What WGSL asks of sines and cosines. Adapters are off by less, but by different amounts.
const TURN: f32 = 1.0 / 2048.0;

fn smallest_distance(samples: &[[f32; 2]]) -> f32 {
    let mut smallest = f32::MAX;
    for (index, a) in samples.iter().enumerate() {
        for b in &samples[..index] {
            smallest = smallest.min((a[0] - b[0]).hypot(a[1] - b[1]));
        }
    }
    smallest
}

#[test]
fn the_poisson_disk_keeps_its_distances_and_fills_rings_of_equal_area() {
    for angle in [0.0, 1.0, -250.0, 6.2] {
        let disk = samples(0, angle);
        // The densest 16 points whose unit disk holds them are 0.55 apart, most of them on its rim.
        assert!(
            smallest_distance(&disk) > 0.455,
            "{}",
            smallest_distance(&disk)
        );
        for (index, sample) in disk.iter().enumerate() {
            let area = sample[0].powi(2) + sample[1].powi(2);
            // Six decimals, and a turn by a vector whose length is off by both.
            assert!(
                (area - (index as f32 + 0.5) / 16.0).abs() < 3e-6 + 3.0 * TURN * area,
                "sample {index} at {angle}"
            );
        }
    }
    // Turned by a quarter, x becomes y.
    let turned = samples(0, std::f32::consts::FRAC_PI_2);
    for (before, after) in samples(0, 0.0).iter().zip(turned) {
        let off = [before[0] - after[1], before[1] + after[0]];
        assert!(
            off.iter().all(|off| off.abs() < 1e-6 + 2.0 * TURN),
            "{off:?}"
        );
    }
}

#[test]
fn sunflowers_of_any_count_cover_the_disk_evenly() {
    for count in [1, 2, 7, 16, 100, 1000] {
        let disk = samples(count, 0.7);
        // Between n points that fill a disk evenly there is room for circles of area pi / n; the spiral leaves 0.85 of the
        // distance that they would have in a square grid.
        let expected = 0.8 * (std::f32::consts::PI / count as f32).sqrt();
        assert!(
            count < 2 || smallest_distance(&disk) > expected,
            "{count}: {} < {expected}",
            smallest_distance(&disk)
        );
        let mean: f32 = disk
            .iter()
            .map(|s| s[0].powi(2) + s[1].powi(2))
            .sum::<f32>()
            / count as f32;
        assert!((mean - 0.5).abs() < 1e-4 + 1.5 * TURN, "{count}: {mean}");
        assert!(disk.iter().all(|s| s[0].hypot(s[1]) < 1.0));
    }
}

#[test]
fn the_angles_of_neighbouring_pixels_fill_the_turn() {
    // Interleaved gradient noise gives any block of 3 x 3 pixels nearly nine evenly spaced values.
    let inputs: Vec<Input> = (0..64 * 64)
        .map(|pixel| Input {
            index: 500 + pixel % 64,
            count: 300 + pixel / 64,
            angle: 0.0,
            padding: 1.0,
        })
        .collect();
    let found = run(&inputs);
    let turns: Vec<f32> = found
        .iter()
        .map(|angle| angle[0] / std::f32::consts::TAU)
        .collect();
    assert!(turns.iter().all(|turn| (0.0..=1.0).contains(turn)));
    for top in 0..61 {
        for left in 0..61 {
            let mut block: Vec<f32> = (0..9)
                .map(|i| turns[(top + i / 3) * 64 + left + i % 3])
                .collect();
            block.sort_by(f32::total_cmp);
            let gaps = block.windows(2).map(|pair| pair[1] - pair[0]);
            let largest = gaps.fold(block[0] + 1.0 - block[8], f32::max);
            // Evenly spaced ones are 1/9 apart, random ones would leave gaps of 0.31 on average.
            assert!(largest < 0.2, "block at {left}, {top}: {largest}");
        }
    }
}
