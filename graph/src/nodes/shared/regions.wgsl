import moment_shadows::map::map_region::{MapRegion, map_region_at_level, map_region_within};
import node::specialization::{GROUP, REGIONS};

// The regions of one layer of a map, which change per frame.

@group(GROUP) @binding(4) var<uniform> regions: array<MapRegion, REGIONS>;

// A region in texels of mip level `level`, in a layer of `size` texels on mip level 0.
fn region_at(number: u32, size: vec2u, level: u32) -> MapRegion {
    return map_region_at_level(map_region_within(regions[number], size), level);
}

// Which part of which region a workgroup makes.
struct RegionTile {
    // The region's number in its table.
    number: u32,
    // The region in texels of a mip level; empty where nothing is left to do.
    region: MapRegion,
    // The tile's first texel, from the region's origin on.
    first: vec2u,
}

// The tile of a workgroup that covers `texels` of mip level `level`, in a layer of `size` texels on mip level 0. The number
// of workgroups does not change, and suffices for all regions.
fn region_tile(workgroup_id: vec3u, workgroups: vec3u, size: vec2u, level: u32, texels: vec2u) -> RegionTile {
    if REGIONS == 1u {
        return RegionTile(0u, region_at(0u, size, level), workgroup_id.xy * texels);
    }
    // Workgroups are numbered through the regions.
    var index = workgroup_id.y * workgroups.x + workgroup_id.x;
    for (var number = 0u; number < REGIONS; number++) {
        let region = region_at(number, size, level);
        let tiles = (region.extent + texels - 1u) / texels;
        let count = tiles.x * tiles.y;
        if index < count {
            return RegionTile(number, region, vec2u(index % tiles.x, index / tiles.x) * texels);
        }
        index -= count;
    }
    return RegionTile(0u, MapRegion(vec2u(0u), vec2u(0u)), vec2u(0u));
}
