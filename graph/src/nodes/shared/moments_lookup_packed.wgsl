import moment_shadows::map::map_region::{MapRegion, map_region_place};
import moment_shadows::moments::packed_four_moments::{packed_four_moments_mean};
import node::specialization::{GROUP};

// The lookup in a map of packed texels, without mip levels: a gather of each of their integers, and the mean of four texels' moments.

@group(GROUP) @binding(2) var moments_map: texture_2d_array<u32>;
@group(GROUP) @binding(3) var moments_sampler: sampler;

// The bilinearly filtered moments at `uv` in [0, 1] across a region. How far apart pixels lie does not matter.
fn moments_lookup(layer: u32, region: MapRegion, uv: vec2f, difference_x: vec2f, difference_y: vec2f) -> vec4f {
    let place = map_region_place(region, uv) - 0.5;
    let base = floor(place);
    let high = place - base;
    let low = 1.0 - high;
    // Where four texels meet, so that rounding matters half a texel away. At the end of a region the ones beyond have no weight.
    let corner = (base + 1.0) / vec2f(textureDimensions(moments_map));
    let depths = textureGather(0, moments_map, moments_sampler, corner, layer);
    let others = textureGather(1, moments_map, moments_sampler, corner, layer);
    let weights = vec4f(low.x, high.x, high.x, low.x) * vec4f(high.y, high.y, low.y, low.y);
    return packed_four_moments_mean(depths, others, weights);
}
