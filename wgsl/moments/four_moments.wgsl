import super::super::map::storage::{STORAGE_FLOAT16, STORAGE_FLOAT32, STORAGE_PACKED32, STORAGE_PACKED64, storage_round_texel, storage_round_to_float16};
import super::super::moments::packed_four_moments::{packed_four_moments_channels, packed_four_moments_from_channels};

// Four moments of depth: encoding, storage, bias.
//
// A texel holds b = (E[z], E[z^2], E[z^3], E[z^4]) of the moment depths z in [-1, 1] that it covers (Peters & Klein,
// "Moment Shadow Mapping", i3D 2015, section 2). Linear filters keep moments valid as long as their weights are not
// negative and sum to one. Storage with few bits holds an affine image of the moments that spreads them over the range
// of every channel (Peters, GDC 2016; JCGT 6(1) 2017, section 3); affine maps commute with filtering.

// A moment bias: b is moved by alpha towards (0, second, 0, fourth), which makes moments valid again that rounding has made
// invalid. If second and fourth are one number beta, these are the moments of occluders at the near end, the middle and the
// far end with the weights beta/2, 1 - beta and beta/2.
struct FourMomentsBias {
    alpha: f32,
    second: f32,
    fourth: f32,
}

// The bias belongs to a storage's rounding error, not to a scene. Each value covers a resolve and a two-pass blur, every
// stage rounded to the storage, for 99.999 % of filter regions (found by search: `moment-shadows-lab bias`). Sums of many texels
// in f32 are off by more than the bias of float32 covers, unless they are made as in `split_sum`. The target is optimal for
// the basis and for distributions on the real line (JCGT 6(1) 2017, section 3).
const FOUR_MOMENTS_BIAS_UNORM16: FourMomentsBias = FourMomentsBias(6e-5, 0.628, 0.628);
const FOUR_MOMENTS_BIAS_FLOAT16: FourMomentsBias = FourMomentsBias(1e-3, 0.628, 0.628);
const FOUR_MOMENTS_BIAS_FLOAT32: FourMomentsBias = FourMomentsBias(1.5e-6, 0.375, 0.375);
// Of maps whose texels are valid, since they were rounded so (`inward_rounding`): three times what texels need by themselves.
const FOUR_MOMENTS_BIAS_ROUNDED_INWARDS_UNORM16: FourMomentsBias = FourMomentsBias(1.5e-5, 0.628, 0.628);
const FOUR_MOMENTS_BIAS_ROUNDED_INWARDS_FLOAT16: FourMomentsBias = FourMomentsBias(1.5e-4, 0.628, 0.628);
// Packed texels hold valid moments, whatever was rounded. This covers sums of four texels' moments and the evaluation, in f32.
const FOUR_MOMENTS_BIAS_PACKED64: FourMomentsBias = FourMomentsBias(1e-6, 0.375, 0.375);
const FOUR_MOMENTS_BIAS_PACKED32: FourMomentsBias = FourMomentsBias(1e-6, 0.375, 0.375);

// sqrt(3), a factor in the optimised basis and its inverse.
const FOUR_MOMENTS_SQRT_3: f32 = 1.7320508075688772;

// The moments of a single depth z in [-1, 1]: its powers (i3D 2015, equation 2).
fn four_moments_from_depth(z: f32) -> vec4f {
    let square = z * z;
    return vec4f(z, square, z * square, square * square);
}

// The optimised basis of JCGT 6(1) 2017 (equation 5, GDC 2016): maps the moments of depths in [-1, 1] into [0, 1]^4.
fn four_moments_quantize(b: vec4f) -> vec4f {
    return vec4f(
        fma(1.5, b.x, fma(-2.0, b.z, 0.5)),
        4.0 * (b.y - b.w),
        fma(0.5 * FOUR_MOMENTS_SQRT_3, b.x, fma(-2.0 / 9.0 * FOUR_MOMENTS_SQRT_3, b.z, 0.5)),
        0.5 * (b.y + b.w),
    );
}

// Inverse of `four_moments_quantize`. Channels in [0, 1] give |b| <= 2.1, whatever they hold.
fn four_moments_dequantize(channels: vec4f) -> vec4f {
    let odd = channels.xz - 0.5;
    return vec4f(
        fma(-1.0 / 3.0, odd.x, FOUR_MOMENTS_SQRT_3 * odd.y),
        fma(0.125, channels.y, channels.w),
        0.75 * fma(FOUR_MOMENTS_SQRT_3, odd.y, -odd.x),
        fma(-0.125, channels.y, channels.w),
    );
}

// Moments clamped to their ranges: odd ones to [-1, 1], even ones to [0, 1]. Float storage can hold anything, and finite
// values beyond 1e15 would overflow further on.
fn four_moments_clamp(b: vec4f) -> vec4f {
    return clamp(b, vec4f(-1.0, 0.0, -1.0, 0.0), vec4f(1.0));
}

// The texel to write in the storage; as packed32 the moments themselves, which `coarse_four_moments_pack` stores.
fn four_moments_to_texel(b: vec4f, stored_as: u32) -> vec4f {
    if stored_as == STORAGE_FLOAT32 || stored_as == STORAGE_PACKED32 {
        return b;
    }
    if stored_as == STORAGE_PACKED64 {
        return packed_four_moments_channels(b);
    }
    let channels = saturate(four_moments_quantize(b));
    if stored_as == STORAGE_FLOAT16 {
        // Half precision is finest around zero, so the channels are centred there.
        return storage_round_to_float16(channels - 0.5);
    }
    return channels;
}

// What a filter averages of a texel: the texel, or the moments of a packed one.
fn four_moments_filter_value(texel: vec4f, stored_as: u32) -> vec4f {
    if stored_as == STORAGE_PACKED64 {
        return packed_four_moments_from_channels(texel);
    }
    return texel;
}

// The texel to write for an average of such values.
fn four_moments_filter_texel(value: vec4f, stored_as: u32) -> vec4f {
    if stored_as == STORAGE_PACKED64 {
        return packed_four_moments_channels(value);
    }
    return storage_round_texel(value, stored_as);
}

// The moments in a (filtered) texel of the storage, or of `four_moments_filter_value` where it is packed. Float storage can hold anything; `four_moments_clamp` comes before any
// arithmetic that relies on ranges.
fn four_moments_from_texel(texel: vec4f, stored_as: u32) -> vec4f {
    if stored_as == STORAGE_FLOAT32 || stored_as == STORAGE_PACKED64 || stored_as == STORAGE_PACKED32 {
        return texel;
    }
    if stored_as == STORAGE_FLOAT16 {
        return four_moments_dequantize(texel + 0.5);
    }
    return four_moments_dequantize(texel);
}

// The moment bias of a storage.
fn four_moments_bias_of(stored_as: u32) -> FourMomentsBias {
    if stored_as == STORAGE_FLOAT32 {
        return FOUR_MOMENTS_BIAS_FLOAT32;
    }
    if stored_as == STORAGE_PACKED64 {
        return FOUR_MOMENTS_BIAS_PACKED64;
    }
    if stored_as == STORAGE_PACKED32 {
        return FOUR_MOMENTS_BIAS_PACKED32;
    }
    if stored_as == STORAGE_FLOAT16 {
        return FOUR_MOMENTS_BIAS_FLOAT16;
    }
    return FOUR_MOMENTS_BIAS_UNORM16;
}

// The moment bias of a map whose texels are rounded inwards.
fn four_moments_bias_rounded_inwards_of(stored_as: u32) -> FourMomentsBias {
    if stored_as == STORAGE_FLOAT16 {
        return FOUR_MOMENTS_BIAS_ROUNDED_INWARDS_FLOAT16;
    }
    return FOUR_MOMENTS_BIAS_ROUNDED_INWARDS_UNORM16;
}

// Applies the moment bias (i3D 2015, section 3.3). Written as a step towards the target: 1 - alpha would keep only a
// few bits of alpha.
fn four_moments_apply_bias(b: vec4f, bias: FourMomentsBias) -> vec4f {
    return fma(vec4f(bias.alpha), vec4f(0.0, bias.second, 0.0, bias.fourth) - b, b);
}

// The biased moments in a (filtered) texel of the storage, or of `four_moments_filter_value` where it is packed, within [-2.1, 2.1]: for unorm storage if the channels are in [0,
// 1], as those of every texture are, and for float storage whatever finite numbers it holds.
fn four_moments_biased_from_texel(texel: vec4f, stored_as: u32, bias: FourMomentsBias) -> vec4f {
    if stored_as == STORAGE_FLOAT32 {
        return four_moments_apply_bias(four_moments_clamp(texel), bias);
    }
    if stored_as == STORAGE_PACKED64 || stored_as == STORAGE_PACKED32 {
        return fma(vec4f(1.0 - bias.alpha), texel, bias.alpha * vec4f(0.0, bias.second, 0.0, bias.fourth));
    }
    // The inverse of the basis and the bias are both affine, and so one step. These biases are large enough for 1 - alpha.
    let keep = 1.0 - bias.alpha;
    let of_xy = keep * vec4f(-1.0 / 3.0, 0.125, -0.75, -0.125);
    let of_zw = keep * vec4f(FOUR_MOMENTS_SQRT_3, 1.0, 0.75 * FOUR_MOMENTS_SQRT_3, 1.0);
    // Odd moments are 0 for channels of one half, and float16 storage holds one half less.
    let middle = select(vec4f(-0.5, 0.0, -0.5, 0.0), vec4f(0.0, 0.5, 0.0, 0.5), stored_as == STORAGE_FLOAT16);
    let shift = fma(middle, of_xy + of_zw, bias.alpha * vec4f(0.0, bias.second, 0.0, bias.fourth));
    let biased = fma(of_xy, texel.xyxy, fma(of_zw, texel.zwzw, shift));
    if stored_as == STORAGE_FLOAT16 {
        return four_moments_clamp(biased);
    }
    return biased;
}
