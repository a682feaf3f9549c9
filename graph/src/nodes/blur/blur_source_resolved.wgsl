import node::map_encoding::{encoding_texel};
import node::resolved::{resolved_channels, resolved_size};

// What the first direction of the blur reads where it resolves: the samples of a depth map. Channels are averaged over samples and
// texels alike and encoded once, so that nothing is rounded in between.

fn blur_size() -> vec2u {
    return resolved_size();
}

// A texel as it is averaged. Beyond `low` and `last`, the corners of the region, its texels repeat.
fn blur_source(texel: vec2i, low: vec2i, last: vec2i, region: u32) -> vec4f {
    return resolved_channels(vec2u(clamp(texel, low, last)), region);
}

// What is stored of an average.
fn blur_stored(average: vec4f) -> vec4f {
    return encoding_texel(average);
}
