import node::map_filtering::{filtering_texel, filtering_value};
import node::map_texture::{texel_of_texture};
import node::specialization::{AXIS, GROUP, KERNELS, MapTexture};

// What a direction of the blur reads.

@group(GROUP) @binding(0) var moments_map: MapTexture;

// Weights that a host can change per frame.
struct BlurParameters {
    // Texels on either side of the centre.
    radius: u32,
    // Blocks of 16 taps: 2 radius + 16 taps, rounded up.
    blocks: u32,
    // Of a map whose regions have kernels of their own, the standard deviation in scene units: for who makes them; not read here.
    width: f32,
    padding: u32,
    // The weights, preceded by 15 zeros and followed by zeros.
    weights: array<vec4f, 40>,
}

@group(GROUP) @binding(2) var<uniform> parameters: array<BlurParameters, KERNELS>;

// Which kernel is a region's: the one of all, or of two for each region that along AXIS.
fn blur_kernel(region: u32) -> u32 {
    return select(2u * region + u32(AXIS.y), 0u, KERNELS == 1u);
}

fn blur_size() -> vec2u {
    return textureDimensions(moments_map);
}

// A texel as it is averaged. Beyond `low` and `last`, the corners of the region, its texels repeat.
fn blur_source(texel: vec2i, low: vec2i, last: vec2i, region: u32) -> vec4f {
    return filtering_value(texel_of_texture(textureLoad(moments_map, clamp(texel, low, last), 0)));
}

// What is stored of an average.
fn blur_stored(average: vec4f) -> vec4f {
    return filtering_texel(average);
}
