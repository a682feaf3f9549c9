// Storages: how the channels of a texel lie in memory, whatever they mean.
//
// Every technique filters linearly and writes after each filter, so each write is a rounding error that the technique's bound
// has to cover. Nothing here depends on a technique: each technique has its way to spread its quantities over the range of a
// storage.

// Storages, as a shader's specialisation names them.
const STORAGE_UNORM16: u32 = 0u;
const STORAGE_FLOAT16: u32 = 1u;
const STORAGE_FLOAT32: u32 = 2u;
const STORAGE_UNORM8: u32 = 3u;
// Sums of channels as unorm16 has them; see `summed_area_encoding`.
const STORAGE_FIXED32: u32 = 4u;
// Three channels to a texel, in maps that are drawn.
const STORAGE_UNORM10: u32 = 5u;
// Four channels, two in [-1, 1] and two in [0, 1], in two 32-bit integers; see `packed_four_moments` for what they mean.
const STORAGE_PACKED64: u32 = 6u;
// Four moments in one 32-bit integer; see `coarse_four_moments`.
const STORAGE_PACKED32: u32 = 7u;

// The largest finite float16.
const STORAGE_LARGEST_FLOAT16: f32 = 65504.0;

// Whether the channels of the storage are floats, which can be anything, rather than numbers in [0, 1].
fn storage_is_float(stored_as: u32) -> bool {
    return stored_as == STORAGE_FLOAT16 || stored_as == STORAGE_FLOAT32;
}

// The integers of a packed texel with the numbers nearest to its channels, of which two are in [-1, 1] and two in [0, 1]; channels beyond
// count as the ends.
fn storage_pack(channels: vec4f) -> vec4u {
    let depths = bitcast<vec2u>(vec2i(round(clamp(channels.xy, vec2f(-1.0), vec2f(1.0)) * 32767.0)));
    let others = vec2u(round(saturate(channels.zw) * 65535.0));
    return vec4u((depths.x & 0xffffu) | (depths.y << 16u), others.x | (others.y << 16u), 0u, 0u);
}

// The channels of a packed texel, each in its range, or a step below -1 where an integer is one that is never written.
fn storage_unpack(texel: vec4u) -> vec4f {
    let depths = vec2f(bitcast<vec2i>(vec2u(texel.x << 16u, texel.x)) >> vec2u(16u));
    let others = vec2f(vec2u(texel.y & 0xffffu, texel.y >> 16u));
    return vec4f(depths / 32767.0, others / 65535.0);
}

// The nearest float16 of each component, ties to even, for |value| <= 65504. A driver may truncate when it stores to a
// float16 texture, which would double the rounding error that a bound has to cover.
fn storage_round_to_float16(value: vec4f) -> vec4f {
    let bits = bitcast<vec4u>(value);
    // 13 of 23 mantissa bits go; adding just under half a unit, plus the last kept bit, rounds ties to even.
    let rounded = bitcast<vec4f>((bits + 0xfffu + ((bits >> vec4u(13u)) & vec4u(1u))) & vec4u(0xffffe000u));
    // Below 2^-14 float16 is a fixed-point format with a step of 2^-24.
    let small = round(value * 16777216.0) * 5.960464477539063e-8;
    return select(rounded, small, abs(value) < vec4f(6.103515625e-5));
}

// The value to draw so that a target of 10 bits per channel holds the number nearest to each component, for any finite value.
// A driver may round down, or round to 16 bits and drop the last six (lavapipe does); the value is a little above that
// number, which they all store then.
fn storage_round_to_unorm10(value: vec4f) -> vec4f {
    return (round(saturate(value) * 1023.0) + 0.00390625) / 1023.0;
}

// A filtered combination of texels, rounded for writing back to the same storage.
fn storage_round_texel(texel: vec4f, stored_as: u32) -> vec4f {
    if stored_as == STORAGE_FLOAT16 {
        return storage_round_to_float16(texel);
    }
    if stored_as == STORAGE_UNORM10 {
        return storage_round_to_unorm10(texel);
    }
    return texel;
}

// A texel whose NaN or infinite channels count as 0. They are found by their bits, since a compiler may assume that neither
// occurs. Unorm texels pass unchanged.
fn storage_finite_texel(texel: vec4f, stored_as: u32) -> vec4f {
    if !storage_is_float(stored_as) {
        return texel;
    }
    let exponent = bitcast<vec4u>(texel) & vec4u(0x7f800000u);
    return select(texel, vec4f(0.0), exponent == vec4u(0x7f800000u));
}
