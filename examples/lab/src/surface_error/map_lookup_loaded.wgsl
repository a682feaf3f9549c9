import moment_shadows::bilinear::{bilinear_load};

// The lookup in a map that the device cannot filter.

@group(0) @binding(3) var moments_map: texture_2d_array<f32>;

fn map_lookup(uv: vec2f, layer: u32) -> vec4f {
    return bilinear_load(moments_map, uv, layer);
}
