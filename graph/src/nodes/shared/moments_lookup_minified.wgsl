import moment_shadows::map::map_lookup::{map_lookup_gradient};
import moment_shadows::map::map_region::{MapRegion};
import node::specialization::{ANISOTROPY, GROUP, LEVELS};

// The lookup in a map with mip levels that the device can filter.

@group(GROUP) @binding(2) var moments_map: texture_2d_array<f32>;
@group(GROUP) @binding(3) var anisotropic_sampler: sampler;

// The texel at `uv` in [0, 1] across a region, filtered over a pixel with these differences of place to its neighbours.
fn moments_lookup(layer: u32, region: MapRegion, uv: vec2f, difference_x: vec2f, difference_y: vec2f) -> vec4f {
    return map_lookup_gradient(moments_map, anisotropic_sampler, layer, region, LEVELS, uv, difference_x, difference_y, ANISOTROPY);
}
