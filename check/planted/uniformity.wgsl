// An error that naga accepts: the level of detail comes from derivatives, which need all pixels of a group of four to come here together.

@group(0) @binding(0) var map: texture_2d<f32>;
@group(0) @binding(1) var map_sampler: sampler;

fn lookup(uv: vec2f) -> f32 {
    return textureSample(map, map_sampler, uv).x;
}

@fragment
fn shade(@location(0) uv: vec2f) -> @location(0) vec4f {
    var intensity = 0.0;
    if uv.x > 0.5 {
        intensity = lookup(uv);
    }
    return vec4f(intensity);
}
