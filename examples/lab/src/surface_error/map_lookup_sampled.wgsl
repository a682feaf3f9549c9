// The lookup in a map that the device can filter.

@group(0) @binding(3) var moments_map: texture_2d_array<f32>;
@group(0) @binding(4) var moments_sampler: sampler;

fn map_lookup(uv: vec2f, layer: u32) -> vec4f {
    return textureSampleLevel(moments_map, moments_sampler, uv, layer, 0.0);
}
