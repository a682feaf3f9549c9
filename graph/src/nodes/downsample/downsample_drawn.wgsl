import node::downsample_texel::{downsample_texel, finer_level};
import node::fullscreen::{Covered};
import moment_shadows::map::map_region::{map_region_at_level, map_region_within};
import node::region_pixel::{region_pixel, regions};
import node::specialization::{REGIONS};

// Makes one mip level of one layer of a map that is drawn out of the finer one: one texel per pixel.

// The mip level that is made, at least 1.
override LEVEL: u32;

@fragment
fn downsample(covered: Covered) -> @location(0) vec4f {
    let size = textureDimensions(finer_level) << vec2u(LEVEL - 1u);
    let pixel = region_pixel(covered.uv, size, LEVEL);
    // What lies in no region is not this pass's.
    if pixel.number == REGIONS {
        discard;
        return vec4f(0.0);
    }
    let finer = map_region_at_level(map_region_within(regions[pixel.number], size), LEVEL - 1u);
    return downsample_texel(pixel.texel - pixel.region.origin, pixel.region.extent, finer);
}
