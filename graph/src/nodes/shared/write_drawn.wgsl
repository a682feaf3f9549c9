import moment_shadows::map::map_region::{MapRegion};
import node::fullscreen::{Covered};
import node::regions::{region_at};
import node::specialization::{REGIONS};
import node::written_texel::{LEVEL, written_size, written_texel};

// Writes a mip level of the regions of one layer of a map that is drawn: one texel per pixel.

@fragment
fn write_map(covered: Covered) -> @location(0) vec4f {
    let size = written_size();
    let drawn = max(size >> vec2u(LEVEL), vec2u(1u));
    let texel = min(vec2u(covered.uv * vec2f(drawn)), drawn - 1u);
    var number = 0u;
    var region: MapRegion;
    for (; number < REGIONS; number++) {
        region = region_at(number, size, LEVEL);
        // Unsigned differences wrap around: a texel before the origin becomes a large number.
        if all(texel - region.origin < region.extent) {
            break;
        }
    }
    // What lies in no region is not this pass's.
    if number == REGIONS {
        discard;
        return vec4f(0.0);
    }
    return written_texel(texel, region, number);
}
