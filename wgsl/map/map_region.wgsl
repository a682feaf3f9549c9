// Regions: rectangles of a layer that share an atlas and do not affect each other.
//
// Mip level k of a region runs from floor(first / 2^k) to floor(end / 2^k). Regions that touch share that edge on every
// level, wherever it lies, so no region covers a texel of another, and no gutter is needed.

// A rectangle in texels of mip level 0, filled by the host-side `MapRegion`. Without texels it stands for no region. A
// rectangle that leaves the map is cut off at the map's border.
struct MapRegion {
    origin: vec2u,
    extent: vec2u,
}

// The part of a region that lies in a map of `size` texels.
fn map_region_within(region: MapRegion, size: vec2u) -> MapRegion {
    let origin = min(region.origin, size);
    return MapRegion(origin, min(region.extent, size - origin));
}

// A region (within its map) on mip level `level`, which is below 32.
fn map_region_at_level(region: MapRegion, level: u32) -> MapRegion {
    let origin = region.origin >> vec2u(level);
    return MapRegion(origin, ((region.origin + region.extent) >> vec2u(level)) - origin);
}

// The coarsest of `levels` mip levels on which a region still has texels.
fn map_region_last_level(region: MapRegion, levels: u32) -> u32 {
    var level = max(levels, 1u) - 1u;
    while level > 0u && any(map_region_at_level(region, level).extent == vec2u(0u)) {
        level--;
    }
    return level;
}

// The place of `uv` (from 0 to 1 across the region) in texels of a region's mip level, kept half a texel away from its edge,
// so that a bilinear filter there reads no other region.
fn map_region_place(region_on_level: MapRegion, uv: vec2f) -> vec2f {
    let extent = vec2f(region_on_level.extent);
    return vec2f(region_on_level.origin) + max(min(uv * extent, extent - 0.5), vec2f(0.5));
}
