import moment_shadows::map::map_region::{MapRegion, map_region_place};
import moment_shadows::map::storage::{storage_unpack};
import moment_shadows::moments::four_moments::{four_moments_filter_value};
import node::specialization::{GROUP, STORAGE};

// The lookup in a map of packed texels, without mip levels: four loads, whose moments are averaged.

@group(GROUP) @binding(2) var moments_map: texture_2d_array<u32>;

fn moments_of_texel(texel: vec2i, layer: u32) -> vec4f {
    return four_moments_filter_value(storage_unpack(textureLoad(moments_map, texel, layer, 0)), STORAGE);
}

// The bilinearly filtered moments at `uv` in [0, 1] across a region. How far apart pixels lie does not matter.
fn moments_lookup(layer: u32, region: MapRegion, uv: vec2f, difference_x: vec2f, difference_y: vec2f) -> vec4f {
    let place = map_region_place(region, uv) - 0.5;
    let base = floor(place);
    let weight = place - base;
    let low = vec2i(base);
    let high = min(low + 1, vec2i(region.origin + region.extent) - 1);
    let top = mix(moments_of_texel(low, layer), moments_of_texel(vec2i(high.x, low.y), layer), weight.x);
    let bottom = mix(moments_of_texel(vec2i(low.x, high.y), layer), moments_of_texel(high, layer), weight.x);
    return mix(top, bottom, weight.y);
}
