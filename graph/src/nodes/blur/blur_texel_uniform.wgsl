import moment_shadows::filter::separable::{separable_add};
import node::blur_source::{blur_kernel, blur_source, parameters};
import node::specialization::{AXIS};

// One texel of a blur along AXIS with weights that a host can change per frame.
fn blur_texel(texel: vec2i, low: vec2i, last: vec2i, region: u32) -> vec4f {
    let kernel = blur_kernel(region);
    // 40 vectors of weights hold no larger kernel.
    let radius = min(parameters[kernel].radius, 64u);
    var sum = vec4f(0.0);
    for (var tap = 0u; tap <= 2u * radius; tap++) {
        // 15 zeros come first.
        let place = tap + 15u;
        let weight = parameters[kernel].weights[place / 4u][place % 4u];
        let source = blur_source(texel + (i32(tap) - i32(radius)) * AXIS, low, last, region);
        sum = separable_add(sum, weight, source, false);
    }
    return sum;
}
