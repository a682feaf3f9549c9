import moment_shadows::specialization::{GROUP};

// The lookup in a map that the device can filter.

@group(GROUP) @binding(2) var moments_map: texture_2d_array<f32>;
@group(GROUP) @binding(3) var moments_sampler: sampler;

fn map_size() -> vec2f {
    return vec2f(textureDimensions(moments_map));
}

// The bilinearly filtered texel of a layer at `uv` in [0, 1].
fn map_lookup(uv: vec2f, layer: u32) -> vec4f {
    return textureSampleLevel(moments_map, moments_sampler, uv, layer, 0.0);
}
