import moment_shadows::map::map_region::{MapRegion, map_region_at_level, map_region_within};
import node::specialization::{GROUP, REGIONS};

// Which region a pixel of a drawn map lies in. Regions change per frame; what is drawn, the whole layer, does not.

@group(GROUP) @binding(4) var<uniform> regions: array<MapRegion, REGIONS>;

struct RegionPixel {
    // The number of its region in the table; REGIONS where it lies in none.
    number: u32,
    // That region in texels of the mip level.
    region: MapRegion,
    // The pixel, a texel of the mip level.
    texel: vec2u,
}

// The pixel at `uv` (from 0 to 1 across the target) of mip level `level`, in a layer of `size` texels on mip level 0.
fn region_pixel(uv: vec2f, size: vec2u, level: u32) -> RegionPixel {
    let drawn = max(size >> vec2u(level), vec2u(1u));
    let texel = min(vec2u(uv * vec2f(drawn)), drawn - 1u);
    for (var number = 0u; number < REGIONS; number++) {
        let region = map_region_at_level(map_region_within(regions[number], size), level);
        // Of unsigned numbers those below the origin wrap around to large ones.
        if all(texel - region.origin < region.extent) {
            return RegionPixel(number, region, texel);
        }
    }
    return RegionPixel(REGIONS, MapRegion(vec2u(0u), vec2u(0u)), texel);
}
