import super::super::map::storage::{STORAGE_FLOAT16, STORAGE_FLOAT32, storage_finite_texel, storage_round_to_float16};

// Two moments of depth: encoding, storage, smallest variance.
//
// A texel holds the mean b1 of depth and its mean square b2. Channels come in pairs (b1, b2): variance shadow mapping uses xy
// alone; a technique that stores two pairs encodes both at once.

// The smallest variance per storage: what rounding in a resolve and a two-pass blur can take away from b2 - b1^2. With e
// the error of a channel per rounding it is at most 3 (error of b2 + 2 |b1| error of b1):
//   unorm16: e = 2^-17, b1 = 2 r - 1 and b2 = 1 - g:   3 (e + 4 e) = 1.2e-4
//   float16: e = 2^-13 for channels within one half:   3 (e + 4 e) = 1.9e-3
//   float32: e = 2^-25 for values up to 1:             3 (e + 2 e) = 2.7e-7, and the sums of both passes are in float32
// This holds with all errors on one side. Half of it covers 99.999 % of adversarial kernels in unorm16 and float16; the sums
// of float32 need a bit more than their value above. A floor as large as the error leaves no variance wrong by more than a
// factor of 2.
const TWO_MOMENTS_SMALLEST_VARIANCE_UNORM16: f32 = 6e-5;
const TWO_MOMENTS_SMALLEST_VARIANCE_FLOAT16: f32 = 1e-3;
const TWO_MOMENTS_SMALLEST_VARIANCE_FLOAT32: f32 = 5e-7;

// The channels to average for a depth z in [-1, 1]: its powers.
fn two_moments_from_depth(z: f32) -> vec4f {
    return vec4f(z, z * z, 0.0, 0.0);
}

// The texel to write for averaged channels. unorm16 has the optimised basis of two moments (r, g) = (u1, 4 u1 - 4 u2), with u
// the moments of (z + 1) / 2 (i3D 2015, section 3.2), which fills the unit square and in terms of z is simply ((b1 + 1) / 2,
// 1 - b2). float16 has these less one half, since half precision is finest around zero. float32 has b itself.
fn two_moments_to_texel(channels: vec4f, stored_as: u32) -> vec4f {
    if stored_as == STORAGE_FLOAT32 {
        return channels;
    }
    let optimised = saturate(fma(vec4f(0.5, -1.0, 0.5, -1.0), channels, vec4f(0.5, 1.0, 0.5, 1.0)));
    if stored_as == STORAGE_FLOAT16 {
        return storage_round_to_float16(optimised - 0.5);
    }
    return optimised;
}

// The moments in a (filtered) texel, both pairs, in their ranges whatever the texel holds.
fn two_moments_from_texel(texel: vec4f, stored_as: u32) -> vec4f {
    let finite = storage_finite_texel(texel, stored_as);
    var channels = finite;
    if stored_as != STORAGE_FLOAT32 {
        let offset = select(vec4f(-1.0, 1.0, -1.0, 1.0), vec4f(0.0, 0.5, 0.0, 0.5), stored_as == STORAGE_FLOAT16);
        channels = fma(vec4f(2.0, -1.0, 2.0, -1.0), finite, offset);
    }
    return clamp(channels, vec4f(-1.0, 0.0, -1.0, 0.0), vec4f(1.0));
}

// The smallest variance of a storage.
fn two_moments_smallest_variance_of(stored_as: u32) -> f32 {
    if stored_as == STORAGE_FLOAT32 {
        return TWO_MOMENTS_SMALLEST_VARIANCE_FLOAT32;
    }
    if stored_as == STORAGE_FLOAT16 {
        return TWO_MOMENTS_SMALLEST_VARIANCE_FLOAT16;
    }
    return TWO_MOMENTS_SMALLEST_VARIANCE_UNORM16;
}
