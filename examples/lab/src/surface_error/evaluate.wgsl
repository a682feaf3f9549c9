import moment_shadows::hamburger::{hamburger_shadow_intensity, hamburger_shadow_intensity_of_texel};
import moment_shadows::leak_reduction::{LeakReduction, leak_reduction_apply};
import moment_shadows::moments::{MomentBias, moments_from_texel};
import moment_shadows::point_lookup::{point_lookup};
import moment_shadows::receiver_bias::{ReceiverBias, receiver_bias_depth};
import moment_shadows::specialization::{STORAGE};

// Shadow intensity of given points of surfaces, step by step as in the node `shade_hard`.

struct Parameters {
    receiver_bias: ReceiverBias,
    leak_reduction: LeakReduction,
    // In place of that of the storage, if its alpha is not 0.
    moment_bias: MomentBias,
}

struct Point {
    // The place in the map, from 0 to 1.
    uv: vec2f,
    // Not clamped.
    moment_depth: f32,
    // Length of the gradient of moment depth per texel of the map.
    gradient: f32,
}

@group(0) @binding(0) var<uniform> parameters: Parameters;
@group(0) @binding(1) var<storage, read> points: array<Point>;
@group(0) @binding(2) var<storage, read_write> intensities: array<f32>;

@compute @workgroup_size(64)
fn evaluate(@builtin(global_invocation_id) id: vec3u) {
    if id.x >= arrayLength(&points) {
        return;
    }
    let point = points[id.x];
    let fragment_depth = min(point.moment_depth, 1.0) - receiver_bias_depth(parameters.receiver_bias, point.gradient);
    let texel = point_lookup(point.uv);
    var intensity = hamburger_shadow_intensity_of_texel(texel, fragment_depth, STORAGE);
    if parameters.moment_bias.alpha > 0.0 {
        let moments = moments_from_texel(texel, STORAGE);
        intensity = hamburger_shadow_intensity(moments, fragment_depth, parameters.moment_bias);
    }
    intensities[id.x] = leak_reduction_apply(intensity, parameters.leak_reduction);
}
