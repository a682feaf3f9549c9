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

const STORAGE_FLOAT16: u32 = 1u;
const STORAGE_FLOAT32: u32 = 2u;


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
