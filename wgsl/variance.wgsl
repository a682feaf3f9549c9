import super::depth::{depth_of_fragment};
import super::storage::{STORAGE_FLOAT16, STORAGE_FLOAT32, storage_finite_texel, storage_round_to_float16};

// Variance shadow mapping: the sharpest bound on shadow intensity that two moments allow.
//
// A texel holds the mean b1 of depth and its mean square b2. The share of depth in front of the fragment is at least
// d^2 / (b2 - b1^2 + d^2) for a fragment at d > 0 behind the mean (Chebyshev's inequality, one-sided; Donnelly &
// Lauritzen, "Variance Shadow Maps", i3D 2006, equation 5). One plane in front of another is reproduced exactly; behind
// two occluders light bleeds (Lauritzen, thesis 2008, section 3.4).
//
// Channels come in pairs (b1, b2). This technique uses xy alone; one that stores two pairs encodes both at once.

// The smallest variance per storage: what rounding in a resolve and a two-pass blur can take away from b2 - b1^2. With e
// the error of a channel per rounding it is at most 3 (error of b2 + 2 |b1| error of b1):
//   unorm16: e = 2^-17, b1 = 2 r - 1 and b2 = 1 - g:   3 (e + 4 e) = 1.2e-4
//   float16: e = 2^-13 for channels within one half:   3 (e + 4 e) = 1.9e-3
//   float32: e = 2^-25 for values up to 1:             3 (e + 2 e) = 2.7e-7, and the sums of both passes are in float32
// That is with all errors on one side. Half of it covers 99.999 % of adversarial kernels in unorm16 and float16; the sums
// of float32 need a bit more than theirs. A floor as large as the error leaves no variance wrong by more than a factor of 2.
const VARIANCE_SMALLEST_UNORM16: f32 = 6e-5;
const VARIANCE_SMALLEST_FLOAT16: f32 = 1e-3;
const VARIANCE_SMALLEST_FLOAT32: f32 = 5e-7;

// What is averaged for a depth z in [-1, 1]: its powers.
fn variance_channels(z: f32) -> vec4f {
    return vec4f(z, z * z, 0.0, 0.0);
}

// What to write for averaged channels. In unorm16 the optimised basis of two moments (r, g) = (u1, 4 u1 - 4 u2), with u the
// moments of (z + 1) / 2 (i3D 2015, section 3.2), which fills the unit square and in terms of z is simply
// ((b1 + 1) / 2, 1 - b2). In float16 the same less one half, around which half precision is finest. In float32 b itself.
fn variance_to_texel(channels: vec4f, storage: u32) -> vec4f {
    if storage == STORAGE_FLOAT32 {
        return channels;
    }
    let optimised = saturate(fma(vec4f(0.5, -1.0, 0.5, -1.0), channels, vec4f(0.5, 1.0, 0.5, 1.0)));
    if storage == STORAGE_FLOAT16 {
        return storage_round_to_float16(optimised - 0.5);
    }
    return optimised;
}

// The moments in a (filtered) texel, both pairs, in their ranges whatever the texel holds.
fn variance_from_texel(texel: vec4f, storage: u32) -> vec4f {
    let finite = storage_finite_texel(texel, storage);
    var channels = finite;
    if storage != STORAGE_FLOAT32 {
        let offset = select(vec4f(-1.0, 1.0, -1.0, 1.0), vec4f(0.0, 0.5, 0.0, 0.5), storage == STORAGE_FLOAT16);
        channels = fma(vec4f(2.0, -1.0, 2.0, -1.0), finite, offset);
    }
    return clamp(channels, vec4f(-1.0, 0.0, -1.0, 0.0), vec4f(1.0));
}

// The smallest variance of a storage.
fn variance_smallest_of(storage: u32) -> f32 {
    if storage == STORAGE_FLOAT32 {
        return VARIANCE_SMALLEST_FLOAT32;
    }
    if storage == STORAGE_FLOAT16 {
        return VARIANCE_SMALLEST_FLOAT16;
    }
    return VARIANCE_SMALLEST_UNORM16;
}

// inf S(z < fragment_depth) over all distributions S with the mean and mean square `moments`; 0 exactly for fragments
// that are not behind the mean. Any unit of depth will do as long as no square exceeds 2^126; `smallest_variance` > 0 is in
// the square of that unit.
fn variance_lower_bound(moments: vec2f, fragment_depth: f32, smallest_variance: f32) -> f32 {
    let variance = max(fma(-moments.x, moments.x, moments.y), smallest_variance);
    let distance = max(fragment_depth - moments.x, 0.0);
    let square = distance * distance;
    return square / (variance + square);
}

// sup S(z <= fragment_depth) likewise; 1 exactly for fragments that are not in front of the mean.
fn variance_upper_bound(moments: vec2f, fragment_depth: f32, smallest_variance: f32) -> f32 {
    return 1.0 - variance_lower_bound(vec2f(-moments.x, moments.y), -fragment_depth, smallest_variance);
}

// Shadow intensity in [0, 1] (1 = shadowed) of a fragment at `fragment_depth` under a filtered texel: a lower bound.
fn variance_shadow_intensity_of_texel(texel: vec4f, fragment_depth: f32, storage: u32) -> f32 {
    let moments = variance_from_texel(texel, storage).xy;
    return variance_lower_bound(moments, depth_of_fragment(fragment_depth), variance_smallest_of(storage));
}
