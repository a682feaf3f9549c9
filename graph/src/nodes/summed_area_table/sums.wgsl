import moment_shadows::filter::prefix_sum::{PrefixSumFour};
import node::specialization::{CHANNELS, GROUP, SumsStorage};

// Sums in textures. All are of four channels; of a texture with two, the others are neither read nor stored, and cost nothing.

@group(GROUP) @binding(1) var target_map: SumsStorage;

// The texel that stores sums.
fn sums_texel(sums: vec4u) -> vec4u {
    return select(vec4u(0u), sums, vec4u(0u, 1u, 2u, 3u) < vec4u(CHANNELS));
}

// The four sums in a row from the texel `first` on. Those beyond the texture are anything.
fn sums_load_four(map: texture_2d<u32>, first: vec2u) -> PrefixSumFour {
    return PrefixSumFour(
        textureLoad(map, first, 0),
        textureLoad(map, first + vec2u(1u, 0u), 0),
        textureLoad(map, first + vec2u(2u, 0u), 0),
        textureLoad(map, first + vec2u(3u, 0u), 0),
    );
}

// Stores the first `count` of four sums in a row, one at least, from the texel `first` on.
fn sums_store_four(first: vec2u, count: u32, sums: PrefixSumFour) {
    textureStore(target_map, first, sums_texel(sums.s0));
    if 1u < count {
        textureStore(target_map, first + vec2u(1u, 0u), sums_texel(sums.s1));
    }
    if 2u < count {
        textureStore(target_map, first + vec2u(2u, 0u), sums_texel(sums.s2));
    }
    if 3u < count {
        textureStore(target_map, first + vec2u(3u, 0u), sums_texel(sums.s3));
    }
}
