// fullscreen
// The vertex stage of fullscreen passes.

struct Covered {
    @builtin(position) position: vec4f,
    // The place in the picture from 0 to 1. Other than `position` it does not depend on where in its target a host has the
    // viewport.
    @location(0) uv: vec2f,
}

@vertex
fn fullscreen(@builtin(vertex_index) index: u32) -> Covered {
    // One triangle that covers the viewport: (-1, -1), (3, -1), (-1, 3).
    let corner = 4.0 * vec2f(f32(index & 1u), f32(index >> 1u)) - 1.0;
    return Covered(vec4f(corner, 0.0, 1.0), 0.5 + vec2f(0.5, -0.5) * corner);
}

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

// moment_shadows/moments/four_moments.wgsl

// Four moments of depth: encoding, storage, bias.
//
// A texel holds b = (E[z], E[z^2], E[z^3], E[z^4]) of the moment depths z in [-1, 1] that it covers (Peters & Klein,
// "Moment Shadow Mapping", i3D 2015, section 2). Linear filters keep moments valid as long as their weights are not
// negative and sum to one. Storage with few bits holds an affine image of the moments that spreads them over the range
// of every channel (Peters, GDC 2016; JCGT 6(1) 2017, section 3); affine maps commute with filtering.

// A moment bias: b is moved by alpha towards (0, second, 0, fourth), which pulls moments that rounding has made
// impossible back among the possible ones. With one number beta for both these are the moments of occluders at the near
// end, the middle and the far end with the weights beta/2, 1 - beta and beta/2.
struct FourMomentsBias {
    alpha: f32,
    second: f32,
    fourth: f32,
}

// The bias belongs to a storage's rounding error, not to a scene. Each value covers a resolve and a two-pass blur, every
// stage rounded to the storage, for 99.999 % of filter regions (found by search: `moment-shadows bias`). Sums of many texels
// in f32 are off by more than the bias of float32 covers, unless they are made as in `split_sum`. The target is optimal for the basis and for distributions on the real line (JCGT 6(1) 2017, section 3).
const FOUR_MOMENTS_BIAS_UNORM16: FourMomentsBias = FourMomentsBias(6e-5, 0.628, 0.628);
const FOUR_MOMENTS_BIAS_FLOAT16: FourMomentsBias = FourMomentsBias(1e-3, 0.628, 0.628);
const FOUR_MOMENTS_BIAS_FLOAT32: FourMomentsBias = FourMomentsBias(1.5e-6, 0.375, 0.375);

// sqrt(3), which the optimised basis and its inverse are made of.
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

// Moments that certainly lie in their ranges: odd ones in [-1, 1], even ones in [0, 1]. Float storage can hold
// anything, and finite values beyond 1e15 would overflow further on.
fn four_moments_clamp(b: vec4f) -> vec4f {
    return clamp(b, vec4f(-1.0, 0.0, -1.0, 0.0), vec4f(1.0));
}

// What to write to a texel of the storage.
fn four_moments_to_texel(b: vec4f, storage: u32) -> vec4f {
    if storage == STORAGE_FLOAT32 {
        return b;
    }
    let channels = saturate(four_moments_quantize(b));
    if storage == STORAGE_FLOAT16 {
        // Half precision is finest around zero, so the channels are centred there.
        return storage_round_to_float16(channels - 0.5);
    }
    return channels;
}

// The moments in a (filtered) texel of the storage. Float storage can hold anything; `four_moments_clamp` comes before any
// arithmetic that relies on ranges.
fn four_moments_from_texel(texel: vec4f, storage: u32) -> vec4f {
    if storage == STORAGE_FLOAT32 {
        return texel;
    }
    if storage == STORAGE_FLOAT16 {
        return four_moments_dequantize(texel + 0.5);
    }
    return four_moments_dequantize(texel);
}

// The moment bias of a storage.
fn four_moments_bias_of(storage: u32) -> FourMomentsBias {
    if storage == STORAGE_FLOAT32 {
        return FOUR_MOMENTS_BIAS_FLOAT32;
    }
    if storage == STORAGE_FLOAT16 {
        return FOUR_MOMENTS_BIAS_FLOAT16;
    }
    return FOUR_MOMENTS_BIAS_UNORM16;
}

// Applies the moment bias (i3D 2015, section 3.3). Written as a step towards the target: 1 - alpha would keep only a
// few bits of alpha.
fn four_moments_apply_bias(b: vec4f, bias: FourMomentsBias) -> vec4f {
    return fma(vec4f(bias.alpha), vec4f(0.0, bias.second, 0.0, bias.fourth) - b, b);
}

// The biased moments in a (filtered) texel of the storage, within [-2.1, 2.1]: for unorm storage if the channels are in
// [0, 1], as no texture can help, and for float storage whatever finite numbers it holds.
fn four_moments_biased_from_texel(texel: vec4f, storage: u32, bias: FourMomentsBias) -> vec4f {
    if storage == STORAGE_FLOAT32 {
        return four_moments_apply_bias(four_moments_clamp(texel), bias);
    }
    // The inverse of the basis and the bias are both affine, and so one step. These biases are large enough for 1 - alpha.
    let keep = 1.0 - bias.alpha;
    let of_xy = keep * vec4f(-1.0 / 3.0, 0.125, -0.75, -0.125);
    let of_zw = keep * vec4f(FOUR_MOMENTS_SQRT_3, 1.0, 0.75 * FOUR_MOMENTS_SQRT_3, 1.0);
    // Odd moments are 0 for channels of one half, and float16 storage holds one half less.
    let middle = select(vec4f(-0.5, 0.0, -0.5, 0.0), vec4f(0.0, 0.5, 0.0, 0.5), storage == STORAGE_FLOAT16);
    let shift = fma(middle, of_xy + of_zw, bias.alpha * vec4f(0.0, bias.second, 0.0, bias.fourth));
    let biased = fma(of_xy, texel.xyxy, fma(of_zw, texel.zwzw, shift));
    if storage == STORAGE_FLOAT16 {
        return four_moments_clamp(biased);
    }
    return biased;
}

// specialization
const GROUP = 0;
const STORAGE = 0u;
const SHOW = 3u;

// debug_moments.wgsl

// A map of moments as a picture, for the day on which a shadow is black or missing.

@group(GROUP) @binding(0) var moments_level: texture_2d<f32>;

// What is shown.
const SHOW_MOMENTS = 0u;
const SHOW_MEAN = 1u;
const SHOW_DEVIATION = 2u;

// The colours of validity.
const NOT_FINITE = vec4f(1.0, 0.0, 1.0, 1.0);
const EMPTY = vec4f(0.1, 0.1, 0.4, 1.0);
const IMPOSSIBLE = vec4f(1.0, 0.0, 0.0, 1.0);
const REPAIRED = vec4f(0.9, 0.8, 0.1, 1.0);
const POSSIBLE = vec4f(0.1, 0.6, 0.2, 1.0);

// Whether any component is infinite or NaN, by its bits.
fn is_not_finite(texel: vec4f) -> bool {
    return any((bitcast<vec4u>(texel) & vec4u(0x7f800000u)) == vec4u(0x7f800000u));
}

// The smaller of the two conditions for moments that some distribution has, both times the variance: the variance itself,
// and the determinant of the Hankel matrix (Peters & Klein, i3D 2015, section 2.2). Not negative where there is one.
fn possible(b: vec4f) -> bool {
    let variance = b.y - b.x * b.x;
    let covariance = b.z - b.x * b.y;
    return variance >= 0.0 && variance * (b.w - b.y * b.y) >= covariance * covariance;
}

fn validity(b: vec4f) -> vec4f {
    // The far end alone: nothing was drawn here, or nothing was resolved.
    if all(abs(b - 1.0) < vec4f(2e-3)) {
        return EMPTY;
    }
    if possible(b) {
        return POSSIBLE;
    }
    // Rounding to the storage makes moments of few surfaces impossible; that is what the moment bias is for.
    return select(IMPOSSIBLE, REPAIRED, possible(four_moments_apply_bias(b, four_moments_bias_of(STORAGE))));
}

@fragment
fn debug(covered: Covered) -> @location(0) vec4f {
    let size = vec2i(textureDimensions(moments_level));
    let place = clamp(vec2i(covered.uv * vec2f(size)), vec2i(0), size - 1);
    let texel = textureLoad(moments_level, place, 0);
    if is_not_finite(texel) {
        return NOT_FINITE;
    }
    let b = clamp(four_moments_from_texel(texel, STORAGE), vec4f(-4.0), vec4f(4.0));
    if SHOW == SHOW_MOMENTS {
        return vec4f(fma(b.xyz, vec3f(0.5, 1.0, 0.5), vec3f(0.5, 0.0, 0.5)), 1.0);
    }
    if SHOW == SHOW_MEAN {
        return vec4f(vec3f(fma(b.x, 0.5, 0.5)), 1.0);
    }
    if SHOW == SHOW_DEVIATION {
        return vec4f(vec3f(sqrt(max(b.y - b.x * b.x, 0.0))), 1.0);
    }
    return validity(b);
}
