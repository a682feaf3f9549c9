// specialization
const GROUP = 0;
const WORKGROUP_X = 8;
const WORKGROUP_Y = 8;
const AXIS = vec2i(1, 0);
alias MomentsStorage = texture_storage_2d<rgba16unorm, write>;
const STORAGE = 0u;
const REGIONS = 1u;

// blur_parameters

// Weights of a blur that a host can change per frame.

struct BlurParameters {
    // Texels on either side of the centre.
    radius: u32,
    // Blocks of 16 taps: 2 radius + OUTPUTS taps, rounded up.
    blocks: u32,
    padding: vec2u,
    // The weights, preceded by 15 zeros and followed by zeros.
    weights: array<vec4f, 40>,
}

@group(GROUP) @binding(2) var<uniform> parameters: BlurParameters;

// moment_shadows/map/storage.wgsl
// Storages: how the channels of a texel lie in memory, whatever they mean.
//
// Every technique filters linearly and writes after each filter, so each write is a rounding error that its bound has to
// cover. Nothing here depends on a technique: how one spreads its quantities over the range of a storage is its own.

// Storages, as a shader's specialisation names them.
const STORAGE_UNORM16: u32 = 0u;
const STORAGE_FLOAT16: u32 = 1u;
const STORAGE_FLOAT32: u32 = 2u;
const STORAGE_UNORM8: u32 = 3u;
// Sums of channels as unorm16 has them; see `summed_area_encoding`.
const STORAGE_FIXED32: u32 = 4u;
// Three channels to a texel, in maps that are drawn.
const STORAGE_UNORM10: u32 = 5u;

// The largest finite float16.
const STORAGE_LARGEST_FLOAT16: f32 = 65504.0;

// Whether the channels of the storage are floats, which can be anything, rather than numbers in [0, 1].
fn storage_is_float(storage: u32) -> bool {
    return storage == STORAGE_FLOAT16 || storage == STORAGE_FLOAT32;
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

// What to draw so that a target of 10 bits per channel holds the nearest number to each component, for any finite value. A driver
// may round down, or round to 16 bits and drop the last six (lavapipe does): a little above that number they give it all the same.
fn storage_round_to_unorm10(value: vec4f) -> vec4f {
    return (round(saturate(value) * 1023.0) + 0.00390625) / 1023.0;
}

// A filtered combination of texels, as it has to be written back to the same storage.
fn storage_round_texel(texel: vec4f, storage: u32) -> vec4f {
    if storage == STORAGE_FLOAT16 {
        return storage_round_to_float16(texel);
    }
    if storage == STORAGE_UNORM10 {
        return storage_round_to_unorm10(texel);
    }
    return texel;
}

// A texel in which channels that are NaN or infinite count as 0, found by their bits since a compiler may assume that
// there is neither. Unorm texels pass as they are.
fn storage_finite_texel(texel: vec4f, storage: u32) -> vec4f {
    if !storage_is_float(storage) {
        return texel;
    }
    let exponent = bitcast<vec4u>(texel) & vec4u(0x7f800000u);
    return select(texel, vec4f(0.0), exponent == vec4u(0x7f800000u));
}

// map_filtering

// Texels that any filter averages.

fn filtering_value(texel: vec4f) -> vec4f {
    return texel;
}

fn filtering_texel(value: vec4f) -> vec4f {
    return storage_round_texel(value, STORAGE);
}

// blur_target

// Where a direction of the blur reads and writes: one layer each.

@group(GROUP) @binding(0) var moments_map: texture_2d<f32>;
@group(GROUP) @binding(1) var blurred_map: MomentsStorage;

// Stores a filtered texel unless it lies beyond `last`, the last texel of the region.
fn blur_store(texel: vec2i, last: vec2i, value: vec4f) {
    if all(texel <= last) {
        textureStore(blurred_map, texel, filtering_texel(value));
    }
}

// blur_unrolled

const OUTPUTS = 16;
struct BlurSums {
    o0: vec4f,
    o1: vec4f,
    o2: vec4f,
    o3: vec4f,
    o4: vec4f,
    o5: vec4f,
    o6: vec4f,
    o7: vec4f,
    o8: vec4f,
    o9: vec4f,
    o10: vec4f,
    o11: vec4f,
    o12: vec4f,
    o13: vec4f,
    o14: vec4f,
    o15: vec4f,
}
fn blur_taps(map: texture_2d<f32>, first: vec2i, low: vec2i, last: vec2i, sums: BlurSums, w0: vec4f, w1: vec4f, w2: vec4f, w3: vec4f, w4: vec4f, w5: vec4f, w6: vec4f, w7: vec4f) -> BlurSums {
    var o0 = sums.o0;
    var o1 = sums.o1;
    var o2 = sums.o2;
    var o3 = sums.o3;
    var o4 = sums.o4;
    var o5 = sums.o5;
    var o6 = sums.o6;
    var o7 = sums.o7;
    var o8 = sums.o8;
    var o9 = sums.o9;
    var o10 = sums.o10;
    var o11 = sums.o11;
    var o12 = sums.o12;
    var o13 = sums.o13;
    var o14 = sums.o14;
    var o15 = sums.o15;
    let t0 = filtering_value(textureLoad(map, clamp(first + 0 * AXIS, low, last), 0));
    o0 = fma(vec4f(w3.w), t0, o0);
    o1 = fma(vec4f(w3.z), t0, o1);
    o2 = fma(vec4f(w3.y), t0, o2);
    o3 = fma(vec4f(w3.x), t0, o3);
    o4 = fma(vec4f(w2.w), t0, o4);
    o5 = fma(vec4f(w2.z), t0, o5);
    o6 = fma(vec4f(w2.y), t0, o6);
    o7 = fma(vec4f(w2.x), t0, o7);
    o8 = fma(vec4f(w1.w), t0, o8);
    o9 = fma(vec4f(w1.z), t0, o9);
    o10 = fma(vec4f(w1.y), t0, o10);
    o11 = fma(vec4f(w1.x), t0, o11);
    o12 = fma(vec4f(w0.w), t0, o12);
    o13 = fma(vec4f(w0.z), t0, o13);
    o14 = fma(vec4f(w0.y), t0, o14);
    o15 = fma(vec4f(w0.x), t0, o15);
    let t1 = filtering_value(textureLoad(map, clamp(first + 1 * AXIS, low, last), 0));
    o0 = fma(vec4f(w4.x), t1, o0);
    o1 = fma(vec4f(w3.w), t1, o1);
    o2 = fma(vec4f(w3.z), t1, o2);
    o3 = fma(vec4f(w3.y), t1, o3);
    o4 = fma(vec4f(w3.x), t1, o4);
    o5 = fma(vec4f(w2.w), t1, o5);
    o6 = fma(vec4f(w2.z), t1, o6);
    o7 = fma(vec4f(w2.y), t1, o7);
    o8 = fma(vec4f(w2.x), t1, o8);
    o9 = fma(vec4f(w1.w), t1, o9);
    o10 = fma(vec4f(w1.z), t1, o10);
    o11 = fma(vec4f(w1.y), t1, o11);
    o12 = fma(vec4f(w1.x), t1, o12);
    o13 = fma(vec4f(w0.w), t1, o13);
    o14 = fma(vec4f(w0.z), t1, o14);
    o15 = fma(vec4f(w0.y), t1, o15);
    let t2 = filtering_value(textureLoad(map, clamp(first + 2 * AXIS, low, last), 0));
    o0 = fma(vec4f(w4.y), t2, o0);
    o1 = fma(vec4f(w4.x), t2, o1);
    o2 = fma(vec4f(w3.w), t2, o2);
    o3 = fma(vec4f(w3.z), t2, o3);
    o4 = fma(vec4f(w3.y), t2, o4);
    o5 = fma(vec4f(w3.x), t2, o5);
    o6 = fma(vec4f(w2.w), t2, o6);
    o7 = fma(vec4f(w2.z), t2, o7);
    o8 = fma(vec4f(w2.y), t2, o8);
    o9 = fma(vec4f(w2.x), t2, o9);
    o10 = fma(vec4f(w1.w), t2, o10);
    o11 = fma(vec4f(w1.z), t2, o11);
    o12 = fma(vec4f(w1.y), t2, o12);
    o13 = fma(vec4f(w1.x), t2, o13);
    o14 = fma(vec4f(w0.w), t2, o14);
    o15 = fma(vec4f(w0.z), t2, o15);
    let t3 = filtering_value(textureLoad(map, clamp(first + 3 * AXIS, low, last), 0));
    o0 = fma(vec4f(w4.z), t3, o0);
    o1 = fma(vec4f(w4.y), t3, o1);
    o2 = fma(vec4f(w4.x), t3, o2);
    o3 = fma(vec4f(w3.w), t3, o3);
    o4 = fma(vec4f(w3.z), t3, o4);
    o5 = fma(vec4f(w3.y), t3, o5);
    o6 = fma(vec4f(w3.x), t3, o6);
    o7 = fma(vec4f(w2.w), t3, o7);
    o8 = fma(vec4f(w2.z), t3, o8);
    o9 = fma(vec4f(w2.y), t3, o9);
    o10 = fma(vec4f(w2.x), t3, o10);
    o11 = fma(vec4f(w1.w), t3, o11);
    o12 = fma(vec4f(w1.z), t3, o12);
    o13 = fma(vec4f(w1.y), t3, o13);
    o14 = fma(vec4f(w1.x), t3, o14);
    o15 = fma(vec4f(w0.w), t3, o15);
    let t4 = filtering_value(textureLoad(map, clamp(first + 4 * AXIS, low, last), 0));
    o0 = fma(vec4f(w4.w), t4, o0);
    o1 = fma(vec4f(w4.z), t4, o1);
    o2 = fma(vec4f(w4.y), t4, o2);
    o3 = fma(vec4f(w4.x), t4, o3);
    o4 = fma(vec4f(w3.w), t4, o4);
    o5 = fma(vec4f(w3.z), t4, o5);
    o6 = fma(vec4f(w3.y), t4, o6);
    o7 = fma(vec4f(w3.x), t4, o7);
    o8 = fma(vec4f(w2.w), t4, o8);
    o9 = fma(vec4f(w2.z), t4, o9);
    o10 = fma(vec4f(w2.y), t4, o10);
    o11 = fma(vec4f(w2.x), t4, o11);
    o12 = fma(vec4f(w1.w), t4, o12);
    o13 = fma(vec4f(w1.z), t4, o13);
    o14 = fma(vec4f(w1.y), t4, o14);
    o15 = fma(vec4f(w1.x), t4, o15);
    let t5 = filtering_value(textureLoad(map, clamp(first + 5 * AXIS, low, last), 0));
    o0 = fma(vec4f(w5.x), t5, o0);
    o1 = fma(vec4f(w4.w), t5, o1);
    o2 = fma(vec4f(w4.z), t5, o2);
    o3 = fma(vec4f(w4.y), t5, o3);
    o4 = fma(vec4f(w4.x), t5, o4);
    o5 = fma(vec4f(w3.w), t5, o5);
    o6 = fma(vec4f(w3.z), t5, o6);
    o7 = fma(vec4f(w3.y), t5, o7);
    o8 = fma(vec4f(w3.x), t5, o8);
    o9 = fma(vec4f(w2.w), t5, o9);
    o10 = fma(vec4f(w2.z), t5, o10);
    o11 = fma(vec4f(w2.y), t5, o11);
    o12 = fma(vec4f(w2.x), t5, o12);
    o13 = fma(vec4f(w1.w), t5, o13);
    o14 = fma(vec4f(w1.z), t5, o14);
    o15 = fma(vec4f(w1.y), t5, o15);
    let t6 = filtering_value(textureLoad(map, clamp(first + 6 * AXIS, low, last), 0));
    o0 = fma(vec4f(w5.y), t6, o0);
    o1 = fma(vec4f(w5.x), t6, o1);
    o2 = fma(vec4f(w4.w), t6, o2);
    o3 = fma(vec4f(w4.z), t6, o3);
    o4 = fma(vec4f(w4.y), t6, o4);
    o5 = fma(vec4f(w4.x), t6, o5);
    o6 = fma(vec4f(w3.w), t6, o6);
    o7 = fma(vec4f(w3.z), t6, o7);
    o8 = fma(vec4f(w3.y), t6, o8);
    o9 = fma(vec4f(w3.x), t6, o9);
    o10 = fma(vec4f(w2.w), t6, o10);
    o11 = fma(vec4f(w2.z), t6, o11);
    o12 = fma(vec4f(w2.y), t6, o12);
    o13 = fma(vec4f(w2.x), t6, o13);
    o14 = fma(vec4f(w1.w), t6, o14);
    o15 = fma(vec4f(w1.z), t6, o15);
    let t7 = filtering_value(textureLoad(map, clamp(first + 7 * AXIS, low, last), 0));
    o0 = fma(vec4f(w5.z), t7, o0);
    o1 = fma(vec4f(w5.y), t7, o1);
    o2 = fma(vec4f(w5.x), t7, o2);
    o3 = fma(vec4f(w4.w), t7, o3);
    o4 = fma(vec4f(w4.z), t7, o4);
    o5 = fma(vec4f(w4.y), t7, o5);
    o6 = fma(vec4f(w4.x), t7, o6);
    o7 = fma(vec4f(w3.w), t7, o7);
    o8 = fma(vec4f(w3.z), t7, o8);
    o9 = fma(vec4f(w3.y), t7, o9);
    o10 = fma(vec4f(w3.x), t7, o10);
    o11 = fma(vec4f(w2.w), t7, o11);
    o12 = fma(vec4f(w2.z), t7, o12);
    o13 = fma(vec4f(w2.y), t7, o13);
    o14 = fma(vec4f(w2.x), t7, o14);
    o15 = fma(vec4f(w1.w), t7, o15);
    let t8 = filtering_value(textureLoad(map, clamp(first + 8 * AXIS, low, last), 0));
    o0 = fma(vec4f(w5.w), t8, o0);
    o1 = fma(vec4f(w5.z), t8, o1);
    o2 = fma(vec4f(w5.y), t8, o2);
    o3 = fma(vec4f(w5.x), t8, o3);
    o4 = fma(vec4f(w4.w), t8, o4);
    o5 = fma(vec4f(w4.z), t8, o5);
    o6 = fma(vec4f(w4.y), t8, o6);
    o7 = fma(vec4f(w4.x), t8, o7);
    o8 = fma(vec4f(w3.w), t8, o8);
    o9 = fma(vec4f(w3.z), t8, o9);
    o10 = fma(vec4f(w3.y), t8, o10);
    o11 = fma(vec4f(w3.x), t8, o11);
    o12 = fma(vec4f(w2.w), t8, o12);
    o13 = fma(vec4f(w2.z), t8, o13);
    o14 = fma(vec4f(w2.y), t8, o14);
    o15 = fma(vec4f(w2.x), t8, o15);
    let t9 = filtering_value(textureLoad(map, clamp(first + 9 * AXIS, low, last), 0));
    o0 = fma(vec4f(w6.x), t9, o0);
    o1 = fma(vec4f(w5.w), t9, o1);
    o2 = fma(vec4f(w5.z), t9, o2);
    o3 = fma(vec4f(w5.y), t9, o3);
    o4 = fma(vec4f(w5.x), t9, o4);
    o5 = fma(vec4f(w4.w), t9, o5);
    o6 = fma(vec4f(w4.z), t9, o6);
    o7 = fma(vec4f(w4.y), t9, o7);
    o8 = fma(vec4f(w4.x), t9, o8);
    o9 = fma(vec4f(w3.w), t9, o9);
    o10 = fma(vec4f(w3.z), t9, o10);
    o11 = fma(vec4f(w3.y), t9, o11);
    o12 = fma(vec4f(w3.x), t9, o12);
    o13 = fma(vec4f(w2.w), t9, o13);
    o14 = fma(vec4f(w2.z), t9, o14);
    o15 = fma(vec4f(w2.y), t9, o15);
    let t10 = filtering_value(textureLoad(map, clamp(first + 10 * AXIS, low, last), 0));
    o0 = fma(vec4f(w6.y), t10, o0);
    o1 = fma(vec4f(w6.x), t10, o1);
    o2 = fma(vec4f(w5.w), t10, o2);
    o3 = fma(vec4f(w5.z), t10, o3);
    o4 = fma(vec4f(w5.y), t10, o4);
    o5 = fma(vec4f(w5.x), t10, o5);
    o6 = fma(vec4f(w4.w), t10, o6);
    o7 = fma(vec4f(w4.z), t10, o7);
    o8 = fma(vec4f(w4.y), t10, o8);
    o9 = fma(vec4f(w4.x), t10, o9);
    o10 = fma(vec4f(w3.w), t10, o10);
    o11 = fma(vec4f(w3.z), t10, o11);
    o12 = fma(vec4f(w3.y), t10, o12);
    o13 = fma(vec4f(w3.x), t10, o13);
    o14 = fma(vec4f(w2.w), t10, o14);
    o15 = fma(vec4f(w2.z), t10, o15);
    let t11 = filtering_value(textureLoad(map, clamp(first + 11 * AXIS, low, last), 0));
    o0 = fma(vec4f(w6.z), t11, o0);
    o1 = fma(vec4f(w6.y), t11, o1);
    o2 = fma(vec4f(w6.x), t11, o2);
    o3 = fma(vec4f(w5.w), t11, o3);
    o4 = fma(vec4f(w5.z), t11, o4);
    o5 = fma(vec4f(w5.y), t11, o5);
    o6 = fma(vec4f(w5.x), t11, o6);
    o7 = fma(vec4f(w4.w), t11, o7);
    o8 = fma(vec4f(w4.z), t11, o8);
    o9 = fma(vec4f(w4.y), t11, o9);
    o10 = fma(vec4f(w4.x), t11, o10);
    o11 = fma(vec4f(w3.w), t11, o11);
    o12 = fma(vec4f(w3.z), t11, o12);
    o13 = fma(vec4f(w3.y), t11, o13);
    o14 = fma(vec4f(w3.x), t11, o14);
    o15 = fma(vec4f(w2.w), t11, o15);
    let t12 = filtering_value(textureLoad(map, clamp(first + 12 * AXIS, low, last), 0));
    o0 = fma(vec4f(w6.w), t12, o0);
    o1 = fma(vec4f(w6.z), t12, o1);
    o2 = fma(vec4f(w6.y), t12, o2);
    o3 = fma(vec4f(w6.x), t12, o3);
    o4 = fma(vec4f(w5.w), t12, o4);
    o5 = fma(vec4f(w5.z), t12, o5);
    o6 = fma(vec4f(w5.y), t12, o6);
    o7 = fma(vec4f(w5.x), t12, o7);
    o8 = fma(vec4f(w4.w), t12, o8);
    o9 = fma(vec4f(w4.z), t12, o9);
    o10 = fma(vec4f(w4.y), t12, o10);
    o11 = fma(vec4f(w4.x), t12, o11);
    o12 = fma(vec4f(w3.w), t12, o12);
    o13 = fma(vec4f(w3.z), t12, o13);
    o14 = fma(vec4f(w3.y), t12, o14);
    o15 = fma(vec4f(w3.x), t12, o15);
    let t13 = filtering_value(textureLoad(map, clamp(first + 13 * AXIS, low, last), 0));
    o0 = fma(vec4f(w7.x), t13, o0);
    o1 = fma(vec4f(w6.w), t13, o1);
    o2 = fma(vec4f(w6.z), t13, o2);
    o3 = fma(vec4f(w6.y), t13, o3);
    o4 = fma(vec4f(w6.x), t13, o4);
    o5 = fma(vec4f(w5.w), t13, o5);
    o6 = fma(vec4f(w5.z), t13, o6);
    o7 = fma(vec4f(w5.y), t13, o7);
    o8 = fma(vec4f(w5.x), t13, o8);
    o9 = fma(vec4f(w4.w), t13, o9);
    o10 = fma(vec4f(w4.z), t13, o10);
    o11 = fma(vec4f(w4.y), t13, o11);
    o12 = fma(vec4f(w4.x), t13, o12);
    o13 = fma(vec4f(w3.w), t13, o13);
    o14 = fma(vec4f(w3.z), t13, o14);
    o15 = fma(vec4f(w3.y), t13, o15);
    let t14 = filtering_value(textureLoad(map, clamp(first + 14 * AXIS, low, last), 0));
    o0 = fma(vec4f(w7.y), t14, o0);
    o1 = fma(vec4f(w7.x), t14, o1);
    o2 = fma(vec4f(w6.w), t14, o2);
    o3 = fma(vec4f(w6.z), t14, o3);
    o4 = fma(vec4f(w6.y), t14, o4);
    o5 = fma(vec4f(w6.x), t14, o5);
    o6 = fma(vec4f(w5.w), t14, o6);
    o7 = fma(vec4f(w5.z), t14, o7);
    o8 = fma(vec4f(w5.y), t14, o8);
    o9 = fma(vec4f(w5.x), t14, o9);
    o10 = fma(vec4f(w4.w), t14, o10);
    o11 = fma(vec4f(w4.z), t14, o11);
    o12 = fma(vec4f(w4.y), t14, o12);
    o13 = fma(vec4f(w4.x), t14, o13);
    o14 = fma(vec4f(w3.w), t14, o14);
    o15 = fma(vec4f(w3.z), t14, o15);
    let t15 = filtering_value(textureLoad(map, clamp(first + 15 * AXIS, low, last), 0));
    o0 = fma(vec4f(w7.z), t15, o0);
    o1 = fma(vec4f(w7.y), t15, o1);
    o2 = fma(vec4f(w7.x), t15, o2);
    o3 = fma(vec4f(w6.w), t15, o3);
    o4 = fma(vec4f(w6.z), t15, o4);
    o5 = fma(vec4f(w6.y), t15, o5);
    o6 = fma(vec4f(w6.x), t15, o6);
    o7 = fma(vec4f(w5.w), t15, o7);
    o8 = fma(vec4f(w5.z), t15, o8);
    o9 = fma(vec4f(w5.y), t15, o9);
    o10 = fma(vec4f(w5.x), t15, o10);
    o11 = fma(vec4f(w4.w), t15, o11);
    o12 = fma(vec4f(w4.z), t15, o12);
    o13 = fma(vec4f(w4.y), t15, o13);
    o14 = fma(vec4f(w4.x), t15, o14);
    o15 = fma(vec4f(w3.w), t15, o15);
    return BlurSums(o0, o1, o2, o3, o4, o5, o6, o7, o8, o9, o10, o11, o12, o13, o14, o15);
}
fn blur_outputs(sums: BlurSums) -> array<vec4f, 16> {
    return array<vec4f, 16>(sums.o0, sums.o1, sums.o2, sums.o3, sums.o4, sums.o5, sums.o6, sums.o7, sums.o8, sums.o9, sums.o10, sums.o11, sums.o12, sums.o13, sums.o14, sums.o15);
}

// moment_shadows/map/map_region.wgsl
// Regions: rectangles of a layer that share an atlas and know nothing of each other.
//
// Mip level k of a region runs from floor(first / 2^k) to floor(end / 2^k). Regions that touch share that edge on every
// level, wherever it lies, so none covers a texel of another, and a gutter is not needed.

// Filled by the host-side `MapRegion`: texels of mip level 0. No texels: no region. A rectangle that leaves the map is
// cut off at its border.
struct MapRegion {
    origin: vec2u,
    extent: vec2u,
}

// The part of a region that lies in a map of `size` texels.
fn map_region_within(region: MapRegion, size: vec2u) -> MapRegion {
    let origin = min(region.origin, size);
    return MapRegion(origin, min(region.extent, size - origin));
}

// A region of a map (within it) on mip level `level`, below 32.
fn map_region_at_level(region: MapRegion, level: u32) -> MapRegion {
    let origin = region.origin >> vec2u(level);
    return MapRegion(origin, ((region.origin + region.extent) >> vec2u(level)) - origin);
}

// The coarsest of `levels` mip levels on which a region still has texels.
fn map_region_last_level(region: MapRegion, levels: u32) -> u32 {
    var level = max(levels, 1u) - 1u;
    while level > 0u && any(map_region_at_level(region, level).extent == vec2u(0u)) {
        level--;
    }
    return level;
}

// The place of `uv` (from 0 to 1 across the region) in texels of a region's mip level, kept half a texel away from its
// edge: a bilinear filter there reads no other region.
fn map_region_place(region_on_level: MapRegion, uv: vec2f) -> vec2f {
    let extent = vec2f(region_on_level.extent);
    return vec2f(region_on_level.origin) + clamp(uv * extent, vec2f(0.5), max(extent - 0.5, vec2f(0.5)));
}

// region_tile

// Which part of which region a workgroup makes. Regions change per frame; the number of workgroups does not, and suffices
// for all of them.

@group(GROUP) @binding(4) var<uniform> regions: array<MapRegion, REGIONS>;

struct RegionTile {
    // The region's number in its table.
    number: u32,
    // The region in texels of a mip level; empty where nothing is left to do.
    region: MapRegion,
    // The tile's first texel, from the region's origin on.
    first: vec2u,
}

// The tile of a workgroup that covers `texels` of mip level `level`, in a layer of `size` texels on mip level 0.
fn region_tile(workgroup: vec3u, workgroups: vec3u, size: vec2u, level: u32, texels: vec2u) -> RegionTile {
    if REGIONS == 1u {
        let only = map_region_at_level(map_region_within(regions[0], size), level);
        return RegionTile(0u, only, workgroup.xy * texels);
    }
    // Workgroups are numbered through the regions.
    var index = workgroup.y * workgroups.x + workgroup.x;
    for (var number = 0u; number < REGIONS; number++) {
        let region = map_region_at_level(map_region_within(regions[number], size), level);
        let tiles = (region.extent + texels - 1u) / texels;
        let count = tiles.x * tiles.y;
        if index < count {
            return RegionTile(number, region, vec2u(index % tiles.x, index / tiles.x) * texels);
        }
        index -= count;
    }
    return RegionTile(0u, MapRegion(vec2u(0u), vec2u(0u)), vec2u(0u));
}

// blur_uniform.wgsl

// One direction of a separable filter over the regions of one layer, with weights that a host can change per frame.
// An invocation makes OUTPUTS texels in a row along AXIS; it runs through the texels in blocks of 16 and through the
// weights in step, keeping the half that the next block needs again.

@compute @workgroup_size(WORKGROUP_X, WORKGROUP_Y)
fn blur(@builtin(local_invocation_id) local: vec3u, @builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u) {
    let outputs = vec2u(1 + (OUTPUTS - 1) * AXIS);
    let tile = region_tile(workgroup, workgroups, textureDimensions(blurred_map), 0u, vec2u(WORKGROUP_X, WORKGROUP_Y) * outputs);
    let place = tile.first + local.xy * outputs;
    if any(place >= tile.region.extent) {
        return;
    }
    let low = vec2i(tile.region.origin);
    let last = low + vec2i(tile.region.extent) - 1;
    let first = low + vec2i(place);
    var sums: BlurSums;
    var w0 = parameters.weights[0];
    var w1 = parameters.weights[1];
    var w2 = parameters.weights[2];
    var w3 = parameters.weights[3];
    // 40 vectors of weights hold 9 blocks.
    let blocks = min(parameters.blocks, 9u);
    for (var block = 0u; block < blocks; block++) {
        let w4 = parameters.weights[4u * block + 4u];
        let w5 = parameters.weights[4u * block + 5u];
        let w6 = parameters.weights[4u * block + 6u];
        let w7 = parameters.weights[4u * block + 7u];
        let tap = i32(16u * block) - i32(parameters.radius);
        sums = blur_taps(moments_map, first + tap * AXIS, low, last, sums, w0, w1, w2, w3, w4, w5, w6, w7);
        w0 = w4;
        w1 = w5;
        w2 = w6;
        w3 = w7;
    }
    let block = blur_outputs(sums);
    blur_store(first, last, block[0]);
    blur_store(first + AXIS, last, block[1]);
    blur_store(first + 2 * AXIS, last, block[2]);
    blur_store(first + 3 * AXIS, last, block[3]);
    blur_store(first + 4 * AXIS, last, block[4]);
    blur_store(first + 5 * AXIS, last, block[5]);
    blur_store(first + 6 * AXIS, last, block[6]);
    blur_store(first + 7 * AXIS, last, block[7]);
    blur_store(first + 8 * AXIS, last, block[8]);
    blur_store(first + 9 * AXIS, last, block[9]);
    blur_store(first + 10 * AXIS, last, block[10]);
    blur_store(first + 11 * AXIS, last, block[11]);
    blur_store(first + 12 * AXIS, last, block[12]);
    blur_store(first + 13 * AXIS, last, block[13]);
    blur_store(first + 14 * AXIS, last, block[14]);
    blur_store(first + 15 * AXIS, last, block[15]);
}
