//! Kernels whose weights are known: a call of the module `separable` for each texel, with its weights as literals.

/// `blur_outputs`: so many times eight outputs at `first`, `first + AXIS`, .. Each eight are stored as soon as their last texel is in, so
/// that sums are as many as the kernel spans, whatever the number of outputs.
pub(super) fn outputs(weights: &[f32], eights: u32) -> String {
    let zeros = [0.0; 7];
    let padded = [&zeros, weights, &zeros].concat();
    let windows: Vec<&[f32]> = padded.windows(8).collect();
    let eights = eights as usize;
    let mut body: String = (0..eights)
        .map(|eight| format!("    var {}: SeparableEight;\n", sums(eight)))
        .collect();
    for (tap, offset) in (0..windows.len() + 8 * (eights - 1)).zip(offsets(weights)) {
        let source = format!("blur_source(first + {offset} * AXIS, low, last, region)");
        // The eights that the texel reaches, with its weights there.
        let reached: Vec<_> = (0..eights)
            .filter_map(|eight| Some((eight, windows.get(tap.checked_sub(8 * eight)?)?)))
            .collect();
        let texel = if reached.len() == 1 {
            source
        } else {
            body += &format!("    let t{tap} = {source};\n");
            format!("t{tap}")
        };
        for (eight, window) in reached {
            let sums = sums(eight);
            body += &format!(
                "    {sums} = separable_add_to_eight({sums}, {texel}, {}, {}, SPLIT_SUMS, true);\n",
                vector(&window[..4]),
                vector(&window[4..])
            );
            if tap == windows.len() - 1 + 8 * eight {
                let place = match eight {
                    0 => "first".to_owned(),
                    _ => format!("first + {} * AXIS", 8 * eight),
                };
                body += &format!("    blur_store({place}, last, {sums});\n");
            }
        }
    }
    "\
import moment_shadows::filter::separable::{SeparableEight, separable_add_to_eight};
import node::blur_source::{blur_source};
import node::blur_target::{blur_store};
import node::specialization::{AXIS, SPLIT_SUMS};

fn blur_outputs(first: vec2i, low: vec2i, last: vec2i, region: u32) {
"
    .to_owned()
        + &body
        + "}\n"
}

/// The variable for the sums of an eight.
fn sums(eight: usize) -> String {
    match eight {
        0 => "sums".to_owned(),
        _ => format!("sums{eight}"),
    }
}

/// `blur_texel`: one output, whose sum is not split.
pub(super) fn texel(weights: &[f32]) -> String {
    let tap = |(offset, weight): (i64, &f32)| {
        format!(
            "    sum = separable_add(sum, {weight:?}, blur_source(texel + {offset} * AXIS, low, last, region), true);\n"
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
