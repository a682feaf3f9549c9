//! Unrolled bodies of the blur: a block of outputs is held in registers while texels stream by.
//!
//! Every texel is loaded once per block instead of once per output, and no workgroup memory is needed. The text is
//! generated because a loop over an array of accumulators is not reliably kept in registers by shader compilers.

use core::fmt::Write;

/// The name of the generated module.
pub(super) const MODULE: &str = "blur_unrolled";

/// Outputs per invocation where weights are literals.
pub(super) const OUTPUTS_LITERAL: usize = 8;

/// Outputs per invocation where weights are uniform.
pub(super) const OUTPUTS_UNIFORM: usize = 16;

/// How products are summed up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sums {
    /// In one sum per output.
    Plain,
    /// In two, as the module `split_sum` describes.
    Split,
}

impl Sums {
    /// What the generated module imports.
    fn imports(self) -> String {
        let split = match self {
            Sums::Plain => "",
            Sums::Split => "import moment_shadows::maths::split_sum::{split_sum_coarse};\n",
        };
        format!(
            "import node::map_filtering::{{filtering_value}};\n\
             import node::specialization::{{AXIS}};\n{split}\n"
        )
    }

    /// The names of the sums of an output, each with that of what it sums of a texel.
    fn parts(self) -> &'static [(&'static str, &'static str)] {
        match self {
            Sums::Plain => &[("o", "t")],
            Sums::Split => &[("o", "c"), ("r", "t")],
        }
    }

    /// Loads texel `tap` at `offset` steps from the first one, in parts.
    fn load(self, body: &mut String, tap: usize, offset: i64) {
        // Writing to a string cannot fail.
        let _ = writeln!(
            body,
            "    {} t{tap} = filtering_value(textureLoad(map, clamp(first + {offset} * AXIS, low, last), 0));",
            if self == Sums::Split { "var" } else { "let" }
        );
        if self == Sums::Split {
            let _ = writeln!(
                body,
                "    let c{tap} = split_sum_coarse(t{tap});\n    t{tap} -= c{tap};"
            );
        }
    }

    /// The outputs, as WGSL expressions.
    fn outputs(self, prefix: &str, count: usize) -> String {
        (0..count)
            .map(|index| {
                let sums: Vec<String> = self
                    .parts()
                    .iter()
                    .map(|(sum, _)| format!("{prefix}{sum}{index}"))
                    .collect();
                sums.join(" + ")
            })
            .collect::<Vec<_>>()
            .join(", ")
    }
}

/// `fn blur_block(map, first, low, last) -> array<vec4f, 8>`: the outputs at `first`, `first + AXIS`, .. with these weights.
/// Beyond `low` and `last`, the corners of the region, its texels repeat.
pub(super) fn literal_weights(weights: &[f32], sums: Sums) -> String {
    let radius = weights.len() / 2;
    let mut body = String::new();
    for tap in 0..OUTPUTS_LITERAL + 2 * radius {
        sums.load(&mut body, tap, tap as i64 - radius as i64);
        for output in 0..OUTPUTS_LITERAL {
            let Some(weight) = tap.checked_sub(output).and_then(|index| weights.get(index)) else {
                continue;
            };
            for (sum, part) in sums.parts() {
                let _ = if tap == output {
                    writeln!(body, "    var {sum}{output} = {weight:?} * {part}{tap};")
                } else {
                    writeln!(
                        body,
                        "    {sum}{output} = fma(vec4f({weight:?}), {part}{tap}, {sum}{output});"
                    )
                };
            }
        }
    }
    format!(
        "{}const OUTPUTS = {OUTPUTS_LITERAL};\n\
         fn blur_block(map: texture_2d<f32>, first: vec2i, low: vec2i, last: vec2i) -> array<vec4f, {OUTPUTS_LITERAL}> {{\n\
         {body}    return array<vec4f, {OUTPUTS_LITERAL}>({});\n}}\n",
        sums.imports(),
        sums.outputs("", OUTPUTS_LITERAL)
    )
}

/// `fn blur_texel(map, texel, low, last) -> vec4f`: one output with these weights, in plain sums. Beyond `low` and `last`, the
/// corners of the region, its texels repeat.
pub(super) fn literal_texel(weights: &[f32]) -> String {
    let radius = weights.len() / 2;
    let mut body = String::new();
    for (tap, weight) in weights.iter().enumerate() {
        let offset = tap as i64 - radius as i64;
        // Writing to a string cannot fail.
        let _ = writeln!(
            body,
            "    sum = fma(vec4f({weight:?}), filtering_value(textureLoad(map, clamp(texel + {offset} * AXIS, low, last), 0)), sum);"
        );
    }
    format!(
        "{}fn blur_texel(map: texture_2d<f32>, texel: vec2i, low: vec2i, last: vec2i) -> vec4f {{\n\
         \x20   var sum = vec4f(0.0);\n{body}    return sum;\n}}\n",
        Sums::Plain.imports()
    )
}

/// `struct BlurSums` of 16 outputs, `fn blur_taps(map, first, low, last, sums, w0, .., w7) -> BlurSums`, which adds the 16
/// texels at `first`, `first + AXIS`, .. to their sums, and `fn blur_outputs(sums) -> array<vec4f, 16>`. Output o takes texel
/// t with weight number t - o + 15.
pub(super) fn uniform_weights(sums: Sums) -> String {
    let components = ["x", "y", "z", "w"];
    let weight = |index: usize| format!("w{}.{}", index / 4, components[index % 4]);
    let mut fields = String::new();
    let mut body = String::new();
    let mut names = Vec::new();
    for (sum, _) in sums.parts() {
        for output in 0..OUTPUTS_UNIFORM {
            let _ = writeln!(fields, "    {sum}{output}: vec4f,");
            let _ = writeln!(body, "    var {sum}{output} = sums.{sum}{output};");
            names.push(format!("{sum}{output}"));
        }
    }
    for tap in 0..16 {
        sums.load(&mut body, tap, tap as i64);
        for output in 0..OUTPUTS_UNIFORM {
            for (sum, part) in sums.parts() {
                let _ = writeln!(
                    body,
                    "    {sum}{output} = fma(vec4f({}), {part}{tap}, {sum}{output});",
                    weight(tap + OUTPUTS_UNIFORM - 1 - output)
                );
            }
        }
    }
    let parameters: String = (0..8).map(|index| format!(", w{index}: vec4f")).collect();
    format!(
        "{}const OUTPUTS = {OUTPUTS_UNIFORM};\n\
         struct BlurSums {{\n{fields}}}\n\
         fn blur_taps(map: texture_2d<f32>, first: vec2i, low: vec2i, last: vec2i, sums: BlurSums{parameters}) -> BlurSums {{\n\
         {body}    return BlurSums({});\n}}\n\
         fn blur_outputs(sums: BlurSums) -> array<vec4f, {OUTPUTS_UNIFORM}> {{\n\
         \x20   return array<vec4f, {OUTPUTS_UNIFORM}>({});\n}}\n",
        sums.imports(),
        names.join(", "),
        sums.outputs("sums.", OUTPUTS_UNIFORM)
    )
}
