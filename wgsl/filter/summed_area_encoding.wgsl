import super::super::moments::four_moments::{FourMomentsBias};

// The integers that a summed-area table sums up, and how exact the means are that are read back.
//
// Channels are those of the storage unorm16: in [0, 1], with the optimised basis. From a unorm16 map they are the map's
// 16-bit integers, with the unit 65535 and no rounding beyond the map's. Other maps are rounded to multiples of 1 / unit with
// unit = floor((2^32 - 1) / n) less the bits that f32 would round, n being the texels of the largest kernel: not 2^32 / n,
// since n channels of exactly 1, as every region without a caster has, would then wrap around to 0 (Peters et al., JCGT 6(1)
// 2017, section 4).

// The most texels of a kernel: n * 65535 < 2^32. Other maps keep to it, too, so that no table is less exact than 16 bits.
const SUMMED_AREA_ENCODING_LARGEST_AREA: u32 = 65537u;

// The unit of a unorm16 map's table.
const SUMMED_AREA_ENCODING_UNIT_UNORM16: f32 = 65535.0;

// The moment bias per error of a channel, for Hamburger's target and the optimised basis (found by maximisation over the
// boundary of the moment space: `moment-shadows-lab bias`).
const SUMMED_AREA_ENCODING_BIAS_PER_ERROR: f32 = 4.88;

// What f32 adds to that bias, in the query, the basis and its inverse; and the least bias, however small the error is (found
// by search: `moment-shadows-lab bias --tables`).
const SUMMED_AREA_ENCODING_BIAS_OF_F32: f32 = 4e-7;
const SUMMED_AREA_ENCODING_SMALLEST_BIAS: f32 = 1e-6;

// The smallest variance of two moments per error e of a channel, 5 e for b2 - b1^2 with b1 = 2 r - 1 and b2 = 1 - g; what f32
// adds to it; and the least one.
const SUMMED_AREA_ENCODING_VARIANCE_PER_ERROR: f32 = 5.0;
const SUMMED_AREA_ENCODING_VARIANCE_OF_F32: f32 = 4e-7;
const SUMMED_AREA_ENCODING_SMALLEST_VARIANCE: f32 = 1.2e-6;

// The 16-bit integers of a texel of unorm16.
fn summed_area_encoding_of_unorm16(texel: vec4f) -> vec4u {
    // At 2^23 the last bit of the mantissa is 1: adding that rounds, and leaves the integer in the low bits.
    return bitcast<vec4u>(fma(texel, vec4f(65535.0), vec4f(8388608.0))) & vec4u(0xffffu);
}

// Channels in [0, 1] in units: channel * unit to the nearest integer, up to 2^-31 of the channel and never above `unit`. f32
// has 8 bits too few for that.
fn summed_area_encoding_of_channels(channels: vec4f, unit: u32) -> vec4u {
    let fraction = vec4u(round(saturate(channels) * 2147483648.0));
    // The upper half of a product of 64 bits, by products of 16.
    let high = fraction >> vec4u(16u);
    let low = fraction & vec4u(0xffffu);
    let unit_high = unit >> 16u;
    let unit_low = unit & 0xffffu;
    let high_low = high * unit_low;
    let low_high = low * unit_high;
    // 0x4000 is one half of a unit: the product is divided by 2^31.
    let middle = ((low * unit_low) >> vec4u(16u)) + (high_low & vec4u(0xffffu)) + (low_high & vec4u(0xffffu)) + 0x4000u;
    let upper = high * unit_high + (high_low >> vec4u(16u)) + (low_high >> vec4u(16u)) + (middle >> vec4u(16u));
    return (upper << vec4u(1u)) | ((middle >> vec4u(15u)) & vec4u(1u));
}

// The moment bias for four moments from a table whose channels are off by up to `error`, on the real line.
fn summed_area_encoding_moment_bias(error: f32) -> FourMomentsBias {
    let alpha = fma(SUMMED_AREA_ENCODING_BIAS_PER_ERROR, error, SUMMED_AREA_ENCODING_BIAS_OF_F32);
    return FourMomentsBias(max(alpha, SUMMED_AREA_ENCODING_SMALLEST_BIAS), 0.628, 0.628);
}

// The smallest variance of two moments from a table whose channels are off by up to `error`.
fn summed_area_encoding_smallest_variance(error: f32) -> f32 {
    let variance = fma(SUMMED_AREA_ENCODING_VARIANCE_PER_ERROR, error, SUMMED_AREA_ENCODING_VARIANCE_OF_F32);
    return max(variance, SUMMED_AREA_ENCODING_SMALLEST_VARIANCE);
}
