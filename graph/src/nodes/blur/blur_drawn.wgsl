import node::blur_texel::{blur_texel};
import node::fullscreen::{Covered};
import node::map_filtering::{filtering_texel};
import node::region_pixel::{region_pixel};
import node::specialization::{GROUP, REGIONS};

// One direction of a separable filter over one layer of a map that is drawn: one texel per pixel.

@group(GROUP) @binding(0) var moments_map: texture_2d<f32>;

@fragment
fn blur(covered: Covered) -> @location(0) vec4f {
    let pixel = region_pixel(covered.uv, textureDimensions(moments_map), 0u);
    // What lies in no region is not this pass's.
    if pixel.number == REGIONS {
        discard;
        return vec4f(0.0);
    }
    let low = vec2i(pixel.region.origin);
    let last = low + vec2i(pixel.region.extent) - 1;
    return filtering_texel(blur_texel(moments_map, vec2i(pixel.texel), low, last));
}
