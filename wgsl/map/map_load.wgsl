import super::super::map::map_region::{MapRegion, map_region_at_level, map_region_last_level, map_region_place};
import super::super::map::minification::{MinificationFootprint, minification_probe};

// Lookups that load texels, for maps that a device cannot filter and for places where a sampler would read across the edge of
// a region: bilinear, trilinear, averaged over a footprint. `uv`, `levels` and regions are as in `map_lookup`.
//
// Texels are loaded and blended here, in f32, while hardware may use weights of as few as 8 bits. Blending texels of moments
// is a convex combination, so it keeps moments valid.

// The texel at a share in [0, 1] of the way from the first to the second; between equal ones that texel exactly, which WGSL does
// not ask of `mix`.
fn map_load_between(first: vec4f, second: vec4f, share: f32) -> vec4f {
    return fma(vec4f(share), second - first, first);
}

// The bilinearly filtered texel on one mip level. `uv` is finite; values outside [0, 1] count as the nearer edge.
fn map_load_bilinear(map: texture_2d_array<f32>, layer: u32, region: MapRegion, uv: vec2f, level: u32) -> vec4f {
    let rectangle = map_region_at_level(region, level);
    let place = map_region_place(rectangle, uv) - 0.5;
    let base = floor(place);
    let weight = place - base;
    let low = vec2i(base);
    let high = min(low + 1, vec2i(rectangle.origin + rectangle.extent) - 1);
    let top = map_load_between(textureLoad(map, low, layer, level), textureLoad(map, vec2i(high.x, low.y), layer, level), weight.x);
    let bottom = map_load_between(textureLoad(map, vec2i(low.x, high.y), layer, level), textureLoad(map, high, layer, level), weight.x);
    return map_load_between(top, bottom, weight.y);
}

// The trilinearly filtered texel: bilinear ones, blended between the two mip levels next to `level` >= 0, as far as the
// region has texels there.
fn map_load_trilinear(map: texture_2d_array<f32>, layer: u32, region: MapRegion, levels: u32, uv: vec2f, level: f32) -> vec4f {
    let last = map_region_last_level(region, levels);
    let fine = min(u32(clamp(level, 0.0, 31.0)), last);
    let texel = map_load_bilinear(map, layer, region, uv, fine);
    let blend = level - f32(fine);
    if fine == last || blend <= 0.0 {
        return texel;
    }
    return map_load_between(texel, map_load_bilinear(map, layer, region, uv, fine + 1u), blend);
}

// The average over a footprint around `uv`: trilinear probes along its major axis.
fn map_load_footprint(map: texture_2d_array<f32>, layer: u32, region: MapRegion, levels: u32, uv: vec2f, footprint: MinificationFootprint) -> vec4f {
    let per_texel = 1.0 / max(vec2f(region.extent), vec2f(1.0));
    var sum = vec4f(0.0);
    for (var probe = 0.0; probe < footprint.probes; probe += 1.0) {
        let probe_uv = uv + minification_probe(footprint, probe) * per_texel;
        sum += map_load_trilinear(map, layer, region, levels, probe_uv, footprint.level);
    }
    return sum / footprint.probes;
}
