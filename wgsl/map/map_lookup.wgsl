import super::super::map::map_load::{map_load_footprint};
import super::super::map::map_region::{MapRegion, map_region_at_level, map_region_place};
import super::super::map::minification::{minification_axes, minification_axes_gradients, minification_footprint};

// Lookups in a filterable map by a sampler: bilinear, and averaged over a pixel. Neither reads across the edge of a region.
//
// `uv` runs from 0 to 1 across the region, v downwards; places are in texels of mip level 0. `levels` is the number of mip
// levels of the map. Samplers filter linearly within and between levels and clamp to the edge. `map_load` has lookups for
// maps that a device cannot filter.

// The bilinearly filtered texel on one mip level. The sampler is not anisotropic: a driver may apply anisotropy to lookups
// with an explicit level, too, and then they reach beyond the region.
fn map_lookup_bilinear(map: texture_2d_array<f32>, linear: sampler, layer: u32, region: MapRegion, uv: vec2f, level: u32) -> vec4f {
    let place = map_region_place(map_region_at_level(region, level), uv);
    return textureSampleLevel(map, linear, place / vec2f(textureDimensions(map, level)), layer, f32(level));
}

// The average over a pixel, from the differences of place to its neighbours in x and y, in texels, each component at most 1e9
// in magnitude. Where the pixel's footprint lies well within a region that hardware would divide into the same mip levels,
// hardware takes the probes, at most as many as the clamp of the sampler `anisotropic`; elsewhere at most `anisotropy` are
// taken here, from loaded texels. Hardware reads most of a region if the region's edges and the size of the map are multiples
// of a texel of the coarsest level.
fn map_lookup_gradient(map: texture_2d_array<f32>, anisotropic: sampler, layer: u32, region: MapRegion, levels: u32, uv: vec2f, difference_x: vec2f, difference_y: vec2f, anisotropy: f32) -> vec4f {
    let size = textureDimensions(map);
    let place = vec2f(region.origin) + uv * vec2f(region.extent);
    let whole = all(region.origin == vec2u(0u)) && all(region.extent == size);
    if whole || map_lookup_is_inner(region, size, levels, place, abs(difference_x) + abs(difference_y)) {
        let per_texel = 1.0 / vec2f(size);
        let gradients = minification_axes_gradients(minification_axes(difference_x, difference_y, anisotropy));
        return textureSampleGrad(map, anisotropic, place * per_texel, layer, gradients[0] * per_texel, gradients[1] * per_texel);
    }
    return map_load_footprint(map, layer, region, levels, uv, minification_footprint(difference_x, difference_y, anisotropy));
}

// Whether hardware that filters around `place` over a box of `reach` texels reads no texel of another region, and divides
// the map into mip levels just as regions are divided: edges and size are multiples of a texel of the coarsest level.
fn map_lookup_is_inner(region: MapRegion, size: vec2u, levels: u32, place: vec2f, reach: vec2f) -> bool {
    let part_of_texel = vec2u((1u << min(max(levels, 1u) - 1u, 31u)) - 1u);
    let aligned = all(((region.origin | region.extent | size) & part_of_texel) == vec2u(0u));
    // Half of the box, and two texels of a mip level whose texels may be twice as wide as the box is long.
    let margin = vec2f(2.0) + 0.5 * reach + 4.0 * max(reach.x, reach.y);
    let low = vec2f(region.origin) + margin;
    let high = vec2f(region.origin + region.extent) - margin;
    return aligned && all(place >= low) && all(place <= high);
}
