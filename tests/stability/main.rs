//! No input makes a NaN or an intensity outside [0, 1], nor one darker than the truth by more than is documented.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic)]

mod report;
mod worst_cases;

use bytemuck::{Pod, Zeroable};
use moment_shadows::Profile;
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Input {
    seed: u32,
    count: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Pod, Zeroable)]
struct Output {
    faults: u32,
    control: u32,
    class: u32,
    result: u32,
    value: u32,
    depth: u32,
    padding: [u32; 2],
    moments: [u32; 4],
}

/// Inputs tried by one invocation.
const EACH: u32 = 128;

/// Invocations: ten million inputs together.
const INVOCATIONS: u32 = 10_000_000_u32.div_ceil(EACH);

#[test]
fn ten_million_hostile_inputs_give_no_nan_and_nothing_out_of_range() {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let batch = Batch::<Input, Output>::new(&gpu, "adversary.wgsl", include_str!("adversary.wgsl"))
        .unwrap();
    let inputs: Vec<Input> = (0..INVOCATIONS)
        .map(|index| Input {
            // An odd multiplier spreads the seeds over all of u32.
            seed: index.wrapping_mul(0x9e37_79b9),
            count: EACH,
        })
        .collect();
    let outputs = batch.run(&inputs).unwrap();
    assert!(
        outputs.iter().all(|output| output.control == 2),
        "the shader does not see a NaN or a number above 1 when there is one"
    );
    let worst: Vec<String> = outputs
        .iter()
        .filter(|output| output.faults > 0)
        .take(10)
        .map(|output| {
            let float = f32::from_bits;
            format!(
                "class {} result {}: {:e} from moments {:?} ({:x?}), depth {:e} ({:#x})",
                output.class,
                output.result,
                float(output.value),
                output.moments.map(float),
                output.moments,
                float(output.depth),
                output.depth
            )
        })
        .collect();
    let faults: u64 = outputs.iter().map(|output| u64::from(output.faults)).sum();
    assert_eq!(faults, 0, "such as\n{}", worst.join("\n"));
}

/// Says how the adapter rounds and asserts nothing about it: WGSL leaves it open. Where `fma` is not fused, errors near a
/// single surface grow, and the guards of the factorisation keep results in range.
#[test]
fn tells_whether_fma_is_fused() {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    let batch =
        Batch::<[f32; 4], [f32; 2]>::new(&gpu, "fused.wgsl", include_str!("fused.wgsl")).unwrap();
    // (1 + 2^-12)^2 = 1 + 2^-11 + 2^-24; the last term survives only a single rounding.
    let factor = 1.0 + 2.0_f32.powi(-12);
    let sum = -(1.0 + 2.0_f32.powi(-11));
    let [explicit, contracted] = batch.run(&[[factor, factor, sum, 0.0]]).unwrap()[0];
    println!(
        "{}: fma is {}fused, a * b + c is {}contracted",
        gpu.adapter.get_info().name,
        if explicit == 0.0 { "not " } else { "" },
        if contracted == 0.0 { "not " } else { "" },
    );
    assert!(explicit.is_finite() && contracted.is_finite());
}
