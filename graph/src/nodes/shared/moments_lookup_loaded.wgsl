import moment_shadows::map::map_load::{map_load_bilinear, map_load_footprint};
import moment_shadows::map::map_region::{MapRegion};
import moment_shadows::map::minification::{minification_footprint};
import node::specialization::{ANISOTROPY, GROUP, LEVELS};

// The lookup in a map that the device cannot filter, or not as well over a pixel.

@group(GROUP) @binding(2) var moments_map: texture_2d_array<f32>;

// The texel at `uv` in [0, 1] across a region, filtered over a pixel with these differences of place to its neighbours.
fn moments_lookup(layer: u32, region: MapRegion, uv: vec2f, difference_x: vec2f, difference_y: vec2f) -> vec4f {
    if LEVELS == 1u {
        return map_load_bilinear(moments_map, layer, region, uv, 0u);
    }
    let footprint = minification_footprint(difference_x, difference_y, ANISOTROPY);
    return map_load_footprint(moments_map, layer, region, LEVELS, uv, footprint);
}
