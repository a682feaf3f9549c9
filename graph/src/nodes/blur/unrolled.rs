//! Kernels whose weights are known: a call of the module `separable` for each texel, with its weights as literals.

/// `blur_outputs`: the eight outputs at `first`, `first + AXIS`, ..
pub(super) fn outputs(weights: &[f32]) -> String {
    let zeros = [0.0; 7];
    let padded = [&zeros, weights, &zeros].concat();
    let tap = |(offset, window): (i64, &[f32])| {
        format!(
            "    sums = separable_add_to_eight(sums, blur_source(first + {offset} * AXIS, low, last), {}, {}, SPLIT_SUMS, true);\n",
            vector(&window[..4]),
            vector(&window[4..])
        )
    };
    let taps: String = offsets(weights).zip(padded.windows(8)).map(tap).collect();
    "\
import moment_shadows::filter::separable::{SeparableEight, separable_add_to_eight};
import node::blur_source::{blur_source};
import node::blur_target::{blur_store};
import node::specialization::{AXIS, SPLIT_SUMS};

fn blur_outputs(first: vec2i, low: vec2i, last: vec2i, region: u32) {
    var sums: SeparableEight;
"
    .to_owned()
        + &taps
        + "    blur_store(first, last, sums);\n}\n"
}

/// `blur_texel`: one output, whose sum is not split.
pub(super) fn texel(weights: &[f32]) -> String {
    let tap = |(offset, weight): (i64, &f32)| {
        format!(
            "    sum = separable_add(sum, {weight:?}, blur_source(texel + {offset} * AXIS, low, last), true);\n"
        )
    };
    let taps: String = offsets(weights).zip(weights).map(tap).collect();
    "\
import moment_shadows::filter::separable::{separable_add};
import node::blur_source::{blur_source};
import node::specialization::{AXIS};

fn blur_texel(texel: vec2i, low: vec2i, last: vec2i, region: u32) -> vec4f {
    var sum = vec4f(0.0);
"
    .to_owned()
        + &taps
        + "    return sum;\n}\n"
}

/// Where the texels lie, from the lowest weight on.
fn offsets(weights: &[f32]) -> impl Iterator<Item = i64> {
    -(weights.len() as i64 / 2)..
}

/// A vector of literals.
fn vector(weights: &[f32]) -> String {
    let literals: Vec<_> = weights.iter().map(|weight| format!("{weight:?}")).collect();
    format!("vec4f({})", literals.join(", "))
}
