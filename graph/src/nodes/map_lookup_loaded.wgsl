import moment_shadows::bilinear::{bilinear_load};
import moment_shadows::specialization::{GROUP};

// The lookup in a map that the device cannot filter.

@group(GROUP) @binding(2) var moments_map: texture_2d_array<f32>;

fn map_size() -> vec2f {
    return vec2f(textureDimensions(moments_map));
}

// The bilinearly filtered texel of a layer at `uv` in [0, 1].
fn map_lookup(uv: vec2f, layer: u32) -> vec4f {
    return bilinear_load(moments_map, uv, layer);
}
