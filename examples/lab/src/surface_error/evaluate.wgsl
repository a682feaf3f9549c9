import moment_shadows::map::depth::{DepthConversion};
import moment_shadows::shade::leak_reduction::{LeakReduction, leak_reduction_apply};
import moment_shadows::map::map_region::{MapRegion};
import moment_shadows::map::range_fit::{RangeFit, range_fit_depth};
import moment_shadows::moments::four_moments::{FourMomentsBias};
import moment_shadows::shade::area_light::{AreaLight};
import node::point_intensity::{point_intensity};
import moment_shadows::shade::receiver_bias::{ReceiverBias, receiver_bias_depth, receiver_bias_fitted, receiver_bias_step};
import node::technique_map::{technique_map_size};
import node::technique_receiver::{TechniqueReceiver};

// Shadow intensity of given points of surfaces, step by step as in the node `shade_hard`.

struct Parameters {
    receiver_bias: ReceiverBias,
    leak_reduction: LeakReduction,
    // In place of that of the storage, where the shader is linked for it.
    moment_bias: FourMomentsBias,
    conversion: DepthConversion,
    light: AreaLight,
    // Of the map, in the range of points and bias.
    range: RangeFit,
}

struct Point {
    // The place in the map, from 0 to 1.
    uv: vec2f,
    // The gradient of moment depth per texel of the map.
    gradient: vec2f,
    // Not clamped.
    moment_depth: f32,
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
    let fit = parameters.range;
    var settings = parameters.receiver_bias;
    let step = fit.scale * receiver_bias_step(settings, point.moment_depth);
    if fit.scale > 1.0 {
        settings = receiver_bias_fitted(settings, fit.scale);
    }
    let depth = min(range_fit_depth(fit, point.moment_depth), 1.0) - step;
    let gradient = fit.scale * point.gradient;
    // Layer 0 as a whole, and without a pixel's footprint: mip level 0.
    let intensity = point_intensity(TechniqueReceiver(
        0u,
        MapRegion(vec2u(0u), technique_map_size()),
        point.uv,
        vec2f(0.0),
        vec2f(0.0),
        gradient,
        depth - receiver_bias_depth(settings, length(gradient)),
        depth - settings.constant,
        (settings.maximum - settings.constant) / max(settings.slope_scale, 1e-30),
        parameters.conversion,
        parameters.light,
        vec2f(vec2u(id.x & 1023u, id.x >> 10u)),
    ), parameters.moment_bias);
    intensities[id.x] = leak_reduction_apply(intensity, parameters.leak_reduction);
}
