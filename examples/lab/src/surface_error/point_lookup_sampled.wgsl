import moment_shadows::map_lookup::{map_lookup_bilinear};
import moment_shadows::map_region::{MapRegion};

// The lookup in a map that the device can filter.

@group(0) @binding(3) var moments_map: texture_2d_array<f32>;
@group(0) @binding(4) var moments_sampler: sampler;

// The bilinearly filtered texel of layer 0 and mip level 0.
fn point_lookup(uv: vec2f) -> vec4f {
    let whole = MapRegion(vec2u(0u), textureDimensions(moments_map));
    return map_lookup_bilinear(moments_map, moments_sampler, 0u, whole, uv, 0u);
}
