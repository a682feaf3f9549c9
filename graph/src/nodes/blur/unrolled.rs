//! Kernels whose weights are known: a call of the module `separable` for each texel, with its weights as literals.

use core::fmt::Write;

/// The name of the generated module that makes a block of outputs.
pub(super) const MODULE: &str = "blur_unrolled";

/// `fn blur_block(map, first, low, last) -> SeparableEight`: the outputs at `first`, `first + AXIS`, .. with these weights. Beyond
/// `low` and `last`, the corners of the region, its texels repeat.
pub(super) fn block(weights: &[f32]) -> String {
    let mut text = "\
import moment_shadows::filter::separable::{SeparableEight, separable_add_to_eight};
import node::blur_source::{blur_source};
import node::specialization::{AXIS, SPLIT_SUMS};

fn blur_block(map: texture_2d<f32>, first: vec2i, low: vec2i, last: vec2i) -> SeparableEight {
    var sums: SeparableEight;
"
    .to_owned();
    let zeros = [0.0; 7];
    let padded = [&zeros, weights, &zeros].concat();
    for (offset, window) in (-radius(weights)..).zip(padded.windows(8)) {
        // Writing to a string cannot fail.
        let (w0, w1) = window.split_at(4);
        let _ = writeln!(
            text,
            "    sums = separable_add_to_eight(sums, blur_source(map, first + {offset} * AXIS, low, last), {}, {}, SPLIT_SUMS, true);",
            vector(w0),
            vector(w1)
        );
    }
    text + "    return sums;\n}\n"
}

/// `fn blur_texel(map, texel, low, last) -> vec4f`: one output with these weights, which is not split. Beyond `low` and `last`, the
/// corners of the region, its texels repeat.
pub(super) fn texel(weights: &[f32]) -> String {
    let mut text = "\
import moment_shadows::filter::separable::{separable_add};
import node::blur_source::{blur_source};
import node::specialization::{AXIS};

fn blur_texel(map: texture_2d<f32>, texel: vec2i, low: vec2i, last: vec2i) -> vec4f {
    var sum = vec4f(0.0);
"
    .to_owned();
    for (offset, weight) in (-radius(weights)..).zip(weights) {
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "    sum = separable_add(sum, {weight:?}, blur_source(map, texel + {offset} * AXIS, low, last), true);"
        );
    }
    text + "    return sum;\n}\n"
}

fn radius(weights: &[f32]) -> i64 {
    weights.len() as i64 / 2
}

/// A vector of literals.
fn vector(weights: &[f32]) -> String {
    let literals: Vec<_> = weights.iter().map(|weight| format!("{weight:?}")).collect();
    format!("vec4f({})", literals.join(", "))
}
