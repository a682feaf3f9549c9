import moment_shadows::map::map_region::{MapRegion, map_region_place};
import moment_shadows::moments::coarse_four_moments::{coarse_four_moments_bilinear};
import node::specialization::{GROUP};

// The lookup in a map of four moments in one integer, without mip levels: a gather, and the mean of four texels' moments.

@group(GROUP) @binding(2) var moments_map: texture_2d_array<u32>;
@group(GROUP) @binding(3) var moments_sampler: sampler;

// The bilinearly filtered moments at `uv` in [0, 1] across a region. How far apart pixels lie does not matter.
fn moments_lookup(layer: u32, region: MapRegion, uv: vec2f, difference_x: vec2f, difference_y: vec2f) -> vec4f {
    let place = map_region_place(region, uv) + 0.5;
    // Where four texels meet, so that rounding matters half a texel away. At the end of a region the ones beyond have no weight.
    let corner = floor(place);
    let corner_uv = corner / vec2f(textureDimensions(moments_map));
    let texels = textureGather(0, moments_map, moments_sampler, corner_uv, layer);
    return coarse_four_moments_bilinear(texels, place - corner);
}
