//! Unrolled bodies of the blur: a block of outputs is held in registers while texels stream by.
//!
//! Every texel is loaded once per block instead of once per output, and no workgroup memory is needed. The text is
//! generated because a loop over an array of accumulators is not reliably kept in registers by shader compilers.

use core::fmt::Write;

/// The name of the generated module.
pub(super) const MODULE: &str = "blur_unrolled";

/// What it imports.
const IMPORTS: &str = "import moment_shadows::map_filtering::{filtering_value};\n\
                       import moment_shadows::specialization::{AXIS};\n\n";

/// Outputs per invocation where weights are literals.
pub(super) const OUTPUTS_LITERAL: usize = 8;

/// Outputs per invocation where weights are uniform.
pub(super) const OUTPUTS_UNIFORM: usize = 16;

/// `fn blur_block(map, first, low, last) -> array<vec4f, 8>`: the outputs at `first`, `first + AXIS`, .. with these weights.
/// Beyond `low` and `last`, the corners of the region, its texels repeat.
pub(super) fn literal_weights(weights: &[f32]) -> String {
    let radius = weights.len() / 2;
    let mut body = String::new();
    for tap in 0..OUTPUTS_LITERAL + 2 * radius {
        let offset = tap as i64 - radius as i64;
        // Writing to a string cannot fail.
        let _ = writeln!(
            body,
            "    let t{tap} = filtering_value(textureLoad(map, clamp(first + {offset} * AXIS, low, last), 0));"
        );
        for output in 0..OUTPUTS_LITERAL {
            let Some(weight) = tap.checked_sub(output).and_then(|index| weights.get(index)) else {
                continue;
            };
            let _ = if tap == output {
                writeln!(body, "    var o{output} = {weight:?} * t{tap};")
            } else {
                writeln!(
                    body,
                    "    o{output} = fma(vec4f({weight:?}), t{tap}, o{output});"
                )
            };
        }
    }
    format!(
        "{IMPORTS}const OUTPUTS = {OUTPUTS_LITERAL};\n\
         fn blur_block(map: texture_2d<f32>, first: vec2i, low: vec2i, last: vec2i) -> array<vec4f, {OUTPUTS_LITERAL}> {{\n\
         {body}    return array<vec4f, {OUTPUTS_LITERAL}>({});\n}}\n",
        list("o", OUTPUTS_LITERAL)
    )
}

/// `struct BlurSums` with 16 sums, and `fn blur_taps(map, first, low, last, sums, w0, .., w7) -> BlurSums`: adds the 16 texels
/// at `first`, `first + AXIS`, .. to the sums of 16 outputs. Output o takes texel t with weight number t - o + 15.
pub(super) fn uniform_weights() -> String {
    let components = ["x", "y", "z", "w"];
    let weight = |index: usize| format!("w{}.{}", index / 4, components[index % 4]);
    let mut fields = String::new();
    let mut body = String::new();
    for output in 0..OUTPUTS_UNIFORM {
        let _ = writeln!(fields, "    o{output}: vec4f,");
        let _ = writeln!(body, "    var o{output} = sums.o{output};");
    }
    for tap in 0..16 {
        let _ = writeln!(
            body,
            "    let t{tap} = filtering_value(textureLoad(map, clamp(first + {tap} * AXIS, low, last), 0));"
        );
        for output in 0..OUTPUTS_UNIFORM {
            let _ = writeln!(
                body,
                "    o{output} = fma(vec4f({}), t{tap}, o{output});",
                weight(tap + OUTPUTS_UNIFORM - 1 - output)
            );
        }
    }
    let parameters: String = (0..8).map(|index| format!(", w{index}: vec4f")).collect();
    format!(
        "{IMPORTS}const OUTPUTS = {OUTPUTS_UNIFORM};\n\
         struct BlurSums {{\n{fields}}}\n\
         fn blur_taps(map: texture_2d<f32>, first: vec2i, low: vec2i, last: vec2i, sums: BlurSums{parameters}) -> BlurSums {{\n\
         {body}    return BlurSums({});\n}}\n",
        list("o", OUTPUTS_UNIFORM)
    )
}

fn list(prefix: &str, count: usize) -> String {
    (0..count)
        .map(|index| format!("{prefix}{index}"))
        .collect::<Vec<_>>()
        .join(", ")
}
