//! Leak reduction: what its three settings make of a bound.

use bytemuck::{Pod, Zeroable};
use moment_shadows::{LeakReduction, Profile};
use moment_shadows_lab::batch::Batch;
use moment_shadows_lab::gpu::Gpu;

const SHADER: &str = "
import moment_shadows::shade::leak_reduction::{LeakReduction, leak_reduction_apply};

struct BatchInput {
    reduction: LeakReduction,
    intensity: f32,
}

struct BatchOutput {
    intensity: f32,
}

fn batch(input: BatchInput) -> BatchOutput {
    return BatchOutput(leak_reduction_apply(input.intensity, input.reduction));
}
";

#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
struct Input {
    reduction: LeakReduction,
    intensity: f32,
}

fn run(inputs: &[Input]) -> Vec<f32> {
    let gpu = Gpu::open(Profile::WebgpuCore).unwrap();
    Batch::<Input, f32>::new(&gpu, "reduction.wgsl", SHADER)
        .unwrap()
        .run(inputs)
        .unwrap()
}

/// Settings on their own and together, with bounds from full light to full shadow.
fn inputs() -> Vec<Input> {
    let mut inputs = Vec::new();
    for full_shadow in [1.0, 0.98, 0.5_f32] {
        for bleed_reduction in [0.0, 0.2, 0.75_f32] {
            for visibility_exponent in [1.0, 0.5, 2.0, 8.0_f32] {
                let reduction = LeakReduction {
                    full_shadow,
                    bleed_reduction,
                    visibility_exponent,
                    padding: 0.0,
                };
                reduction.check().unwrap();
                inputs.extend((0..=256).map(|step| Input {
                    reduction,
                    intensity: step as f32 / 256.0,
                }));
            }
        }
    }
    inputs
}

#[test]
fn each_setting_does_what_is_written_of_it() {
    let inputs = inputs();
    for (input, found) in inputs.iter().zip(run(&inputs)) {
        let LeakReduction {
            full_shadow,
            bleed_reduction,
            visibility_exponent,
            ..
        } = input.reduction;
        let visibility = 1.0 - (f64::from(input.intensity) / f64::from(full_shadow)).min(1.0);
        let bleed = f64::from(bleed_reduction);
        let remaining = ((visibility - bleed) / (1.0 - bleed)).max(0.0);
        let expected = 1.0 - remaining.powf(f64::from(visibility_exponent));
        // Visibility and what remains of it are off by 2^-24 over 1 - bleed, three times, and a power multiplies that by its
        // exponent at most. Its root is steep at 0. Powers go through logarithms, which WGSL lets be off by 2^-21, times
        // the exponent, times the power.
        let step = 4.0 * 2f64.powi(-24) / (1.0 - bleed);
        let exponent = f64::from(visibility_exponent);
        let slope = if exponent < 1.0 {
            exponent * (remaining.max(step)).powf(exponent - 1.0)
        } else {
            exponent
        };
        let tolerance = slope.max(1.0) * step + 8.0 * 2f64.powi(-21);
        assert!(
            (f64::from(found) - expected).abs() <= tolerance,
            "{input:?}: {found}, not {expected}"
        );
    }
}

#[test]
fn light_stays_light_and_what_counts_as_shadow_is_shadow() {
    let inputs = inputs();
    for (input, found) in inputs.iter().zip(run(&inputs)) {
        let reduction = input.reduction;
        // An exponent below 1 is the only setting that lightens.
        let darkens = reduction.visibility_exponent >= 1.0;
        assert!(
            !darkens || found >= input.intensity - 1e-6,
            "{input:?} gave {found}"
        );
        if input.intensity == 0.0 {
            assert_eq!(found, 0.0, "{input:?}");
        }
        // A step of 2^-24 away from the limits, where rounding decides.
        let visibility = 1.0 - input.intensity / reduction.full_shadow;
        if visibility < reduction.bleed_reduction - 1e-6 || visibility < -1e-6 {
            assert_eq!(found, 1.0, "{input:?}");
        }
        if reduction.bleed_reduction == 0.0
            && visibility > 1e-6
            && reduction.visibility_exponent <= 2.0
        {
            assert!(found < 1.0, "{input:?}");
        }
    }
    // Without any of them the bound is what it was, to the bit.
    let plain: Vec<Input> = inputs
        .iter()
        .map(|input| Input {
            reduction: LeakReduction::NONE,
            ..*input
        })
        .collect();
    for (input, found) in plain.iter().zip(run(&plain)) {
        // Multiples of 2^-8: visibility is exact.
        assert_eq!(found, input.intensity);
    }
}

/// The setting that is refused of a full shadow, a bleed reduction and an exponent.
fn refused([full_shadow, bleed_reduction, visibility_exponent]: [f32; 3]) -> Option<&'static str> {
    let reduction = LeakReduction {
        full_shadow,
        bleed_reduction,
        visibility_exponent,
        padding: 0.0,
    };
    reduction.check().err().map(|error| error.name)
}

#[test]
fn settings_out_of_their_ranges_are_refused_by_name() {
    for value in [0.0, -0.5, 1.0625, f32::NAN, f32::INFINITY] {
        assert_eq!(refused([value, 0.0, 1.0]), Some("full_shadow"), "{value}");
    }
    for value in [-0.0625, 1.0, 2.0, f32::NAN, f32::INFINITY] {
        assert_eq!(
            refused([1.0, value, 1.0]),
            Some("bleed_reduction"),
            "{value}"
        );
    }
    for value in [0.0, -1.0, f32::NAN, f32::INFINITY] {
        assert_eq!(
            refused([1.0, 0.0, value]),
            Some("visibility_exponent"),
            "{value}"
        );
    }
    for settings in [[1.0, 0.0, 1.0], [1e-3, 0.999, 1e3], [0.98, 0.0, 1e-3]] {
        assert_eq!(refused(settings), None, "{settings:?}");
    }
}
