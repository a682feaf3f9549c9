import moment_shadows::map::map_region::{MapRegion};
import node::fullscreen::{Covered};
import node::regions::{region_at};
import node::specialization::{REGIONS};
import node::written_texel::{LEVEL, written_size, written_texel};

// Writes a mip level of the regions of one layer of a map that is drawn: one texel per pixel.

struct RegionPixel {
    // The number of its region in the table; REGIONS outside every region.
    number: u32,
    // That region in texels of the mip level.
    region: MapRegion,
}

fn region_of(texel: vec2u, size: vec2u) -> RegionPixel {
    for (var number = 0u; number < REGIONS; number++) {
        let region = region_at(number, size, LEVEL);
        // Unsigned differences wrap around: a texel before the origin becomes a large number.
        if all(texel - region.origin < region.extent) {
            return RegionPixel(number, region);
        }
    }
    return RegionPixel(REGIONS, MapRegion(vec2u(0u), vec2u(0u)));
}

@fragment
fn write_map(covered: Covered) -> @location(0) vec4f {
    let size = written_size();
    let drawn = max(size >> vec2u(LEVEL), vec2u(1u));
    let texel = min(vec2u(covered.uv * vec2f(drawn)), drawn - 1u);
    let pixel = region_of(texel, size);
    // What lies in no region is not this pass's.
    if pixel.number == REGIONS {
        discard;
        return vec4f(0.0);
    }
    return written_texel(texel, pixel.region, pixel.number);
}
