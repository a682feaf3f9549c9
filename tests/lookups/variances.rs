//! The variance that lookups add to the depths of a plane, and the bias that follows from it.

use bytemuck::{Pod, Zeroable};
use moment_shadows::{Profile, ReceiverBias};
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;

const SHADER: &str = "
import moment_shadows::map::minification::{MinificationFootprint, minification_depth_variance};
import moment_shadows::shade::receiver_bias::{ReceiverBias, receiver_bias_depth, receiver_bias_depth_minified};

struct BatchInput {
    bias: ReceiverBias,
    major: vec2f,
    gradient: vec2f,
    probes: f32,
    level: f32,
    padding: vec2f,
}

struct BatchOutput {
    variance: f32,
    // Without that variance, and with it.
    plain: f32,
    minified: f32,
}

fn batch(input: BatchInput) -> BatchOutput {
    let footprint = MinificationFootprint(input.major, input.probes, input.level);
    let variance = minification_depth_variance(footprint, input.gradient);
    let steepness = length(input.gradient);
    return BatchOutput(
        variance,
        receiver_bias_depth(input.bias, steepness),
        receiver_bias_depth_minified(input.bias, steepness, variance),
    );
}
";

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Input {
    bias: ReceiverBias,
    major: [f32; 2],
    gradient: [f32; 2],
    probes: f32,
    level: f32,
    padding: [f32; 2],
}

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Output {
    variance: f32,
    plain: f32,
    minified: f32,
}

fn run(inputs: &[Input]) -> Vec<Output> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    Batch::new(&gpu, "variances.wgsl", SHADER)
        .unwrap()
        .run(inputs)
        .unwrap()
}

/// Footprints of probes that fill a line, on levels and between them, over planes of all slopes.
fn inputs() -> Vec<Input> {
    let mut random = ChaCha8Rng::seed_from_u64(41);
    let input = |index: usize| {
        let level = [0.0, 1.0, 2.0, random.random_range(0.0..4.0_f32)][index % 4];
        let probes = [1.0, 2.0, 5.0, 16.0][index / 4 % 4];
        let turn = random.random_range(0.0..std::f32::consts::TAU);
        let line = probes * level.exp2() * random.random_range(0.5..1.0);
        let mut slope = || 1e-2 * random.random_range(-1.0..1.0_f32);
        let gradient = [slope(), slope()];
        Input {
            bias: ReceiverBias::for_kernel(random.random_range(0.0..3.0), 1.0),
            major: [line * turn.cos(), line * turn.sin()],
            gradient,
            probes,
            level,
            padding: [0.0; 2],
        }
    };
    (0..1600).map(input).collect()
}

/// The variance of the depths that a texel of a lookup averages, over all places of lookups: probes on the line, of which
/// each takes boxes of `t` texels and blends those next to it, on each of two levels.
fn exact(input: &Input) -> f64 {
    let [along, across] = [
        f64::from(input.major[0]) * f64::from(input.gradient[0])
            + f64::from(input.major[1]) * f64::from(input.gradient[1]),
        f64::from(input.gradient[0]).hypot(f64::from(input.gradient[1])),
    ];
    let probes = input.probes as u32;
    let places = (0..probes).map(|probe| (f64::from(probe) + 0.5) / f64::from(probes) - 0.5);
    let of_line = places.map(|place| (place * along).powi(2)).sum::<f64>() / f64::from(probes);
    let level = f64::from(input.level);
    let share = level.fract();
    let of_level = |level: f64| {
        // A map's own texels are what the bias of its kernel is for.
        let width = if level > 0.0 { level.exp2() } else { 0.0 };
        // A box, and two of them a width apart blended at a place between: 1/12, and the mean of s (1 - s), 1/6.
        let steps = 1000;
        let blend: f64 = (0..steps)
            .map(|step| (f64::from(step) + 0.5) / f64::from(steps))
            .map(|s| s * (1.0 - s))
            .sum();
        (width * across).powi(2) * (1.0 / 12.0 + blend / f64::from(steps))
    };
    of_line + (1.0 - share) * of_level(level.floor()) + share * of_level(level.ceil())
}

#[test]
fn it_covers_what_mip_levels_and_probes_add_and_little_more() {
    let inputs = inputs();
    for (input, found) in inputs.iter().zip(run(&inputs)) {
        let (exact, found) = (exact(input), f64::from(found.variance));
        // Dozens of products, each off by 2^-24.
        assert!(
            found >= exact * (1.0 - 1e-5),
            "{input:?}: {found} < {exact}"
        );
        // Between levels 0 and 1 the finer one counts as nothing above. On a level 1.27 times its variance is what the worst
        // mixture of two levels has; two probes on a line have 3/4 of its variance.
        let most = match (input.level, input.probes) {
            (level, _) if level > 0.0 && level < 1.0 => continue,
            (_, 1.0) => 1.27,
            (_, _) => 4.0 / 3.0,
        };
        assert!(
            found <= exact * most * (1.0 + 1e-5) + 1e-30,
            "{input:?}: {found} > {most} of {exact}"
        );
    }
}

#[test]
fn the_bias_moves_by_the_deviation_of_kernel_and_lookup_together() {
    let inputs = inputs();
    for (input, found) in inputs.iter().zip(run(&inputs)) {
        let [x, y] = input.gradient.map(f64::from);
        let constant = f64::from(input.bias.constant);
        let kernel = f64::from(input.bias.slope_scale) * x.hypot(y);
        let added = f64::from(ReceiverBias::STANDARD_DEVIATIONS) * f64::from(found.variance).sqrt();
        let expected = constant + (kernel * kernel + added * added).sqrt();
        let minified = f64::from(found.minified);
        // These slopes are far from the steepest one.
        assert!(
            (minified - expected).abs() <= 1e-5 * expected,
            "{input:?}: {minified}, not {expected}"
        );
        assert!(
            minified >= f64::from(found.plain) * (1.0 - 1e-6),
            "{input:?}"
        );
        if input.level == 0.0 && input.probes == 1.0 {
            assert!(
                (minified - f64::from(found.plain)).abs() <= 1e-6 * expected,
                "{input:?}"
            );
        }
    }
}

#[test]
fn its_limit_is_one_of_slope() {
    // As steep as counts, and a thousand times steeper: both move by the same, and by as much more than without mip levels
    // as the lookup is wider than the kernel.
    let at = |factor: f64| -> Vec<Input> {
        let steepest = |input: &Input| {
            f64::from(input.bias.maximum - input.bias.constant) / f64::from(input.bias.slope_scale)
        };
        let steeper = |input: Input| {
            let length = f64::from(input.gradient[0]).hypot(f64::from(input.gradient[1]));
            let scale = factor * steepest(&input) / length;
            Input {
                gradient: input.gradient.map(|it| (f64::from(it) * scale) as f32),
                ..input
            }
        };
        inputs().into_iter().map(steeper).collect()
    };
    let (limit, beyond) = (at(1.0), at(1000.0));
    for ((input, limit), beyond) in limit.iter().zip(run(&limit)).zip(run(&beyond)) {
        let kernel = f64::from(input.bias.maximum - input.bias.constant);
        let added = f64::from(ReceiverBias::STANDARD_DEVIATIONS) * f64::from(limit.variance).sqrt();
        let expected = f64::from(input.bias.constant) + kernel.hypot(added);
        for found in [limit.minified, beyond.minified].map(f64::from) {
            assert!(
                (found - expected).abs() <= 1e-4 * expected,
                "{input:?}: {found}, not {expected}"
            );
        }
    }
}
