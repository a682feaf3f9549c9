import super::super::map::depth::{depth_of_fragment};
import super::super::map::storage::{STORAGE_FLOAT16, STORAGE_LARGEST_FLOAT16, storage_finite_texel, storage_round_to_float16};
import super::super::bounds::chebyshev::{chebyshev_lower_bound};

// Exponential variance shadow mapping: the bound of two moments for warped depth.
//
// A lower bound stays one if depth is warped by an increasing function. w+ = e^(c+ z) pulls all occluders but the last ones
// together, so that less light bleeds behind them, and w- = -e^(-c- z) does the same for receivers; the darker bound of both
// is taken (Lauritzen & McCool, "Layered Variance Shadow Maps", GI 2008, section 6; Lauritzen, thesis 2008, section 4.2). The
// minus sign in w- is what makes it increase. w+ alone takes two channels (EVSM2), both take four (EVSM4).
//
// Warps are not normalised: e^(c z) for signed z spends the exponent range of a float evenly on both sides of 1, while
// e^(c (z - 1)) would leave the upper half of it unused.

// The largest exponents, so that w and w^2 fit the storage.
//   float32: both stay normal numbers, below which devices may flush to zero, with the weights of a usual kernel of 129 taps as well:
//            2^-10 e^(-2 c) >= 2^-126, so c <= 58 log 2 = 40.2
//   float16: w^2 <= 65504, so c <= 5.54. Far squares then are subnormal, which the smallest variance covers.
// Larger exponents make no NaN, but their results are not bounds.
const EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT16: f32 = 5.54;
const EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT32: f32 = 40.0;

// 2^63, whose square is a number still.
const EXPONENTIAL_VARIANCE_LARGEST_WARP: f32 = 9.223372036854776e18;

// The smallest variance is x * E[w^2] + y. It is the error that rounding in a resolve and a two-pass blur leaves in E[w^2] -
// E[w]^2: with the relative error u = 2^-11 or 2^-24 of a rounding at most 3 (u + 2 u) E[w^2] = 4.4e-3 or 5.4e-7 times
// E[w^2]. In depth, where w has the slope c w, that is a variance of x / c^2. As in `two_moments`, half of it covers 99.999 %
// of kernels in float16. y covers numbers below the normal ones: 3 steps of 2^-25, or what float32 flushes to zero.
const EXPONENTIAL_VARIANCE_SMALLEST_FLOAT16: vec2f = vec2f(2.2e-3, 9e-8);
const EXPONENTIAL_VARIANCE_SMALLEST_FLOAT32: vec2f = vec2f(6e-7, 1e-37);

// In the unit of `exponential_variance_lower_bound`: above zero for invalid texels too, and far below what f32 resolves there.
const EXPONENTIAL_VARIANCE_LEAST: f32 = 1e-30;

// The warps (w+, w-) of a depth in [-1, 1] with the exponents (c+, c-).
fn exponential_variance_warp(z: f32, exponents: vec2f) -> vec2f {
    let limited = clamp(exponents, vec2f(0.0), vec2f(EXPONENTIAL_VARIANCE_LARGEST_EXPONENT_FLOAT32));
    return vec2f(exp(limited.x * z), -exp(-limited.y * z));
}

// The channels to average for a depth z in [-1, 1]: (w+, w+^2, w-, w-^2). EVSM2 stores the first two.
fn exponential_variance_channels(z: f32, exponents: vec2f) -> vec4f {
    let warped = exponential_variance_warp(z, exponents);
    return vec4f(warped, warped * warped).xzyw;
}

// The texel to write for averaged channels.
fn exponential_variance_to_texel(channels: vec4f, stored_as: u32) -> vec4f {
    if stored_as == STORAGE_FLOAT16 {
        let largest = vec4f(STORAGE_LARGEST_FLOAT16);
        return storage_round_to_float16(clamp(channels, -largest, largest));
    }
    return channels;
}

// The lower bound for a warped fragment and the first two moments of the same warp, which may be any finite numbers. The size
// of the fragment's warp is from 2^-63 to 2^63.
fn exponential_variance_lower_bound(moments: vec2f, warped: f32, stored_as: u32) -> f32 {
    let largest = EXPONENTIAL_VARIANCE_LARGEST_WARP;
    let clamped = clamp(moments, vec2f(-largest, 0.0), vec2f(largest, largest * largest));
    let is_half = stored_as == STORAGE_FLOAT16;
    let smallest = select(EXPONENTIAL_VARIANCE_SMALLEST_FLOAT32, EXPONENTIAL_VARIANCE_SMALLEST_FLOAT16, is_half);
    // In a unit near the larger of the warp and the root of its mean square, a power of two: near the camera warps are so small that
    // squares of their differences would be flushed to zero.
    let square = max(warped * warped, clamped.y);
    let halved = (i32(bitcast<u32>(square) >> 23u) - 127) >> 1u;
    let unit = bitcast<f32>(u32(127 - halved) << 23u);
    let mean = clamp(clamped.x * unit, -2.0, 2.0);
    let scaled = vec2f(mean, clamped.y * unit * unit);
    let variance = max(fma(smallest.x, scaled.y, smallest.y * unit * unit), EXPONENTIAL_VARIANCE_LEAST);
    return chebyshev_lower_bound(scaled, warped * unit, variance);
}

// Shadow intensity in [0, 1] (1 = shadowed) of a fragment at `fragment_depth` under a filtered texel: a lower bound, from
// both warps or from w+ alone.
fn exponential_variance_shadow_intensity_of_texel(
    texel: vec4f,
    fragment_depth: f32,
    stored_as: u32,
    exponents: vec2f,
    both: bool,
) -> f32 {
    let warped = exponential_variance_warp(depth_of_fragment(fragment_depth), exponents);
    let moments = storage_finite_texel(texel, stored_as);
    let positive = exponential_variance_lower_bound(moments.xy, warped.x, stored_as);
    if !both {
        return positive;
    }
    // A mean of w- is negative; positive garbage would put the mean behind every fragment, which does no harm.
    return max(positive, exponential_variance_lower_bound(moments.zw, warped.y, stored_as));
}
