import node::blur_parameters::{parameters};
import node::map_filtering::{filtering_value};
import node::specialization::{AXIS};

// One texel of a blur along AXIS with weights that a host can change per frame. Beyond `low` and `last`, the corners of the
// region, its texels repeat.
fn blur_texel(map: texture_2d<f32>, texel: vec2i, low: vec2i, last: vec2i) -> vec4f {
    // 40 vectors of weights hold no larger kernel.
    let radius = min(parameters.radius, 64u);
    var sum = vec4f(0.0);
    for (var tap = 0u; tap <= 2u * radius; tap++) {
        // 15 zeros come first.
        let place = tap + 15u;
        let weight = parameters.weights[place / 4u][place % 4u];
        let source = clamp(texel + (i32(tap) - i32(radius)) * AXIS, low, last);
        sum = fma(vec4f(weight), filtering_value(textureLoad(map, source, 0)), sum);
    }
    return sum;
}
