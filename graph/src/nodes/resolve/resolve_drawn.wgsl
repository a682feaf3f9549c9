import node::fullscreen::{Covered};
import node::region_pixel::{region_pixel};
import node::resolve_texel::{depth_map, resolve_texel};
import node::specialization::{REGIONS};

// Resolves one layer of a depth map to one plane of a filterable map that is drawn: one texel per pixel.

@fragment
fn resolve(covered: Covered) -> @location(0) vec4f {
    let pixel = region_pixel(covered.uv, textureDimensions(depth_map), 0u);
    // What lies in no region is not this pass's.
    if pixel.number == REGIONS {
        discard;
        return vec4f(0.0);
    }
    return resolve_texel(vec2i(pixel.texel), pixel.number);
}
