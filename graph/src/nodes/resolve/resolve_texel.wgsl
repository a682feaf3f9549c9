import moment_shadows::map::map_region::{MapRegion};
import node::map_encoding::{encoding_texel};
import node::resolved::{resolved_channels, resolved_size};

// What a texel of one plane of a filterable map holds, from one layer of a depth map.

const LEVEL = 0u;

fn written_size() -> vec2u {
    return resolved_size();
}

fn written_texel(texel: vec2u, region: MapRegion, number: u32) -> vec4f {
    return encoding_texel(resolved_channels(texel, number));
}
