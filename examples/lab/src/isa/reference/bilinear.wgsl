import node::fullscreen::{Interpolated};

// What every filterable shadow costs at least: one bilinear fetch.

@group(0) @binding(0) var map: texture_2d<f32>;
@group(0) @binding(1) var map_sampler: sampler;

@fragment
fn shade(input: Interpolated) -> @location(0) vec4f {
    return textureSample(map, map_sampler, input.place.xy);
}
