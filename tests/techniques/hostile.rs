//! No bits of a texel or a depth make a NaN or an intensity outside [0, 1].

use bytemuck::{Pod, Zeroable};
use moment_shadows::Profile;
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Input {
    texel: [u32; 4],
    splits: [f32; 4],
    exponents: [f32; 2],
    depth: u32,
    storage: u32,
    terms: u32,
    layers: u32,
    overlap: f32,
    damping: f32,
}

const RESULTS: [&str; 12] = [
    "variance",
    "variance, upper",
    "layered variance",
    "layered variance of the last plane",
    "last layer",
    "exponential",
    "exponential, logarithmic",
    "exponential variance 2",
    "exponential variance 4",
    "convolution, lower bound",
    "convolution",
    "hausdorff",
];

/// Bits of a float: any, not finite, subnormal, huge, in or near the range of channels and depths.
fn bits(random: &mut ChaCha8Rng) -> u32 {
    const SPECIAL: [f32; 14] = [
        0.0,
        -0.0,
        1.0,
        -1.0,
        0.5,
        -0.5,
        f32::MAX,
        f32::MIN,
        f32::MIN_POSITIVE,
        f32::INFINITY,
        f32::NEG_INFINITY,
        f32::NAN,
        65504.0,
        1e19,
    ];
    let plain: u32 = random.random();
    match random.random_range(0..6) {
        0 => plain,
        1 => SPECIAL[random.random_range(0..SPECIAL.len())].to_bits(),
        // Subnormal, or NaN with any payload.
        2 => (plain & 0x807f_ffff) | [0, 0x7f80_0000][random.random_range(0..2)],
        3 => random.random_range(-1.0..=1.0_f32).to_bits(),
        4 => random.random_range(0.0..=1.0_f32).to_bits(),
        _ => {
            let magnitude = 10.0_f32.powf(random.random_range(-45.0..38.0));
            magnitude.to_bits() | (plain & 0x8000_0000)
        }
    }
}

#[test]
fn a_million_hostile_texels_and_depths_give_no_nan_and_nothing_out_of_range() {
    const COUNT: u32 = 1_000_000;
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let inputs: Vec<Input> = (0..COUNT)
        .map(|index| {
            let mut splits: [f32; 4] = core::array::from_fn(|_| random.random_range(-1.5..1.5));
            // Coincident ones too.
            if random.random_range(0..4) == 0 {
                splits = [splits[0]; 4];
            }
            splits.sort_by(f32::total_cmp);
            let mut texel: [u32; 4] = core::array::from_fn(|_| bits(&mut random));
            // Moments of one surface, and its fragment: no variance at all.
            let depth = if random.random_range(0..8) == 0 {
                let surface: f32 = random.random_range(-1.0..=1.0);
                texel = [1, 2, 3, 4].map(|power| surface.powi(power).to_bits());
                surface.to_bits()
            } else {
                bits(&mut random)
            };
            Input {
                texel,
                splits,
                exponents: core::array::from_fn(|_| {
                    if random.random() {
                        random.random_range(0.0..60.0)
                    } else {
                        random.random_range(-10.0..1e3)
                    }
                }),
                depth,
                storage: index % 4,
                terms: random.random_range(0..20),
                layers: random.random_range(0..10),
                overlap: [0.0, random.random_range(0.0..0.5)][random.random_range(0..2)],
                damping: random.random_range(-1.0..100.0),
            }
        })
        .collect();
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let outputs: Vec<[f32; 12]> = Batch::new(&gpu, "hostile.wgsl", include_str!("hostile.wgsl"))
        .unwrap()
        .run(&inputs)
        .unwrap();
    let mut faults = [0_u32; RESULTS.len()];
    let mut examples = Vec::new();
    let mut nonzero = [0_u32; RESULTS.len()];
    for (input, output) in inputs.iter().zip(&outputs) {
        for (result, &value) in output.iter().enumerate() {
            nonzero[result] += u32::from(value > 0.0);
            // NaN is in no range.
            if !(0.0..=1.0).contains(&value) {
                faults[result] += 1;
                if faults[result] <= 2 {
                    let texel = input.texel.map(f32::from_bits);
                    let depth = f32::from_bits(input.depth);
                    let name = RESULTS[result];
                    examples.push(format!(
                        "{name}: {value:e} from {texel:?}, depth {depth:e}, {input:?}"
                    ));
                }
            }
        }
    }
    assert!(examples.is_empty(), "{faults:?}\n{}", examples.join("\n"));
    // Not just zeros.
    for (name, count) in RESULTS.iter().zip(nonzero) {
        assert!(
            count > COUNT / 50,
            "{name} is above 0 in {count} cases only"
        );
    }
}
