import moment_shadows::map::map_region::{MapRegion};
import node::blur_source::{blur_size, blur_stored};
import node::blur_texel::{blur_texel};

// What a texel of a map that is drawn holds after one direction of a separable filter.

const LEVEL = 0u;

fn written_size() -> vec2u {
    return blur_size();
}

fn written_texel(texel: vec2u, region: MapRegion, number: u32) -> vec4f {
    let low = vec2i(region.origin);
    let last = low + vec2i(region.extent) - 1;
    return blur_stored(blur_texel(vec2i(texel), low, last, number));
}
