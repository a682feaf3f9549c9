import moment_shadows::map::map_lookup::{map_lookup_bilinear};
import moment_shadows::map::map_region::{MapRegion};
import node::specialization::{GROUP};

// The lookup in a map that the device can filter, without mip levels.

@group(GROUP) @binding(2) var moments_map: texture_2d_array<f32>;
@group(GROUP) @binding(3) var moments_sampler: sampler;

// The bilinearly filtered texel at `uv` in [0, 1] across a region. How far apart pixels lie does not matter.
fn moments_lookup(layer: u32, region: MapRegion, uv: vec2f, difference_x: vec2f, difference_y: vec2f) -> vec4f {
    return map_lookup_bilinear(moments_map, moments_sampler, layer, region, uv, 0u);
}
