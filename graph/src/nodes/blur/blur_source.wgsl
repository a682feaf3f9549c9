import node::map_filtering::{filtering_value};

// What a blur reads, as it is averaged. Beyond `low` and `last`, the corners of the region, its texels repeat.

fn blur_source(map: texture_2d<f32>, texel: vec2i, low: vec2i, last: vec2i) -> vec4f {
    return filtering_value(textureLoad(map, clamp(texel, low, last), 0));
}
