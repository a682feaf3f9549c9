import moment_shadows::map::storage::{storage_unpack};
import moment_shadows::moments::packed_four_moments::{packed_four_moments_from_channels};
import moment_shadows::moments::inward_rounding::{inward_rounding_texel};
import node::map_encoding::{encoding_texel};
import node::specialization::{GROUP, ROUNDED_INWARDS, STORAGE};

// What the second direction of the blur reads where the first one resolves four moments: packed texels of 64 bits, whose moments are
// valid and almost exact. They are averaged, and texels of the map that is made are rounded inwards, or once alone.

@group(GROUP) @binding(0) var moments_map: texture_2d<u32>;

fn blur_size() -> vec2u {
    return textureDimensions(moments_map);
}

// The moments of a texel. Beyond `low` and `last`, the corners of the region, its texels repeat.
fn blur_source(texel: vec2i, low: vec2i, last: vec2i, region: u32) -> vec4f {
    return packed_four_moments_from_channels(storage_unpack(textureLoad(moments_map, clamp(texel, low, last), 0)));
}

// What is stored of an average.
fn blur_stored(average: vec4f) -> vec4f {
    if ROUNDED_INWARDS {
        return inward_rounding_texel(average, STORAGE);
    }
    return encoding_texel(average);
}
